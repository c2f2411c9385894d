// Several structures as one: rigid bodies beside elastic ones. Walls and their coordinates stand below each other in the order of
// the parts; Z and M are block-diagonal, since parts do not touch each other. Contacts that are closed within a part restrict
// its own modes and leave those of the others as they are.
#pragma once

#include <memory>

#include "coupling/participant.hpp"

namespace splashdown::coupling {

/// Drives its parts in their order.
class Composite final : public StructurePart {
 public:
  /// At least one part, none null; all at the same time. Throws std::invalid_argument otherwise.
  explicit Composite(std::vector<std::unique_ptr<StructurePart>> parts);

  double time() const override { return parts_.front()->time(); }
  double stable_dt() const override;
  void save(std::ostream& out) const override;
  void load(std::istream& in) override;

  /// Those of the parts, joined by " and ".
  std::string name() const override;
  const std::vector<WallCoordinates>& walls() const override { return walls_; }
  const Eigen::VectorXd& scales() const override { return scales_; }
  double length() const override;
  Eigen::VectorXd speeds(const Velocities& velocities) const override;
  Velocities velocities() const override;

  void begin(const Step& step) override;
  Response response() const override;
  const Velocities& solve(const Impulse& impulse) override;
  const Velocities& adopt(const Velocities& velocities) override;
  bool update_contacts(const Impulse& impulse) override;
  Placement placement() const override;
  void see_wetted(const Eigen::VectorXd& measures) override;
  Status acceptable() const override;
  void commit() override;

 private:
  /// The walls as the parts have them now.
  void see_walls();
  /// One below the other: what `each` gives of a part and of where its coordinates are.
  template <class Each>
  Eigen::VectorXd stacked(const Each& each) const;

  std::vector<std::unique_ptr<StructurePart>> parts_;
  std::vector<WallCoordinates> walls_;
  Eigen::VectorXd scales_;
  Velocities trial_;
};

}  // namespace splashdown::coupling
