// Force and moment that act between the two parts of a body at sections across an axis: shear force and bending moment.
//
//   F(s) = sum over the part ahead, axis . r >= s, of   p dA + g dm - (a + A r) dm,      A = [alpha] + [w][w]
//   M(s) = the same of moments about the point s axis
//
// p: pressure of the water with that of repairs on the facets of the hull, cut exactly; a, alpha, w: of the body, in the step's kick. So
// F and M are what the part behind takes over from the part ahead. What the water does besides its pressure at the facets (friction,
// smoothing of the pressure that is told) is spread evenly over the wet facets, so that the whole is the load of the body.
// Ahead of the body F and M are zero. Behind it they are minus what else acts on the body: joints, lines, contacts, air, whoever holds it;
// and in M the change of w with moments of inertia that are not those of the mass that is spread (section_mass.hpp).
// Bending is positive where it hogs, as in the rules of ship classification.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/files/csv.hpp"
#include "apps/record/recorder.hpp"
#include "apps/record/settings.hpp"

namespace splashdown::apps {

inline constexpr const char* section_loads_header = "time,record,station,fx,fy,fz,mx,my,mz,shear,bending";

/// Body axes; in two dimensions per metre of depth, forces without z, moments with z alone.
struct SectionLoad {
  double station = 0;  ///< along the axis in the frame of the shape [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();  ///< [N, N m]
  double shear = 0;    ///< positive where the part ahead is pushed up [N]
  double bending = 0;  ///< positive where the body hogs: tension in its upper side [N m]
};

/// At each station of the record, in its order. Cost: a pass over the wet facets of the body, and over those that each section cuts.
template <int d>
std::vector<SectionLoad> section_loads(const SectionRecord<d>& record, const RecordInput<d>& input);

void write_rows(CsvFile& file, double time, const std::string& record, const std::vector<SectionLoad>& loads);

/// The largest of all steps so far.
class SectionExtremes {
 public:
  void offer(double time, const std::vector<SectionLoad>& loads);
  const SectionPeak& shear() const { return shear_; }
  const SectionPeak& hogging() const { return hogging_; }
  const SectionPeak& sagging() const { return sagging_; }

  template <class Archive>
  void serialize(Archive& archive) {
    for (auto* peak : {&shear_, &hogging_, &sagging_}) archive(peak->value, peak->time, peak->station);
  }

 private:
  SectionPeak shear_, hogging_, sagging_;
};

}  // namespace splashdown::apps
