// Several structures as one: the same as if their modes were those of one structure.
#include "coupling/composite.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "coupling/schemes/steppers.hpp"
#include "tests/unit/coupling/toys.hpp"

namespace splashdown::coupling::composite_test {
namespace {

using toys::Matrix;
using toys::Modal;
using toys::Vector;
using toys::Water;

constexpr double eps = std::numeric_limits<double>::epsilon();

/// Three coordinates of one wall, two of another: whole, or as two parts.
Matrix some(Eigen::Index n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Matrix R = Matrix::NullaryExpr(n, n, [&] { return uniform(random); });
  return Matrix::Identity(n, n) + R.transpose() * R;
}

Matrix diagonal(const Matrix& a, const Matrix& b) {
  Matrix all = Matrix::Zero(a.rows() + b.rows(), a.cols() + b.cols());
  all.topLeftCorner(a.rows(), a.cols()) = a;
  all.bottomRightCorner(b.rows(), b.cols()) = b;
  return all;
}

struct Bodies {
  Matrix M1 = some(3, 1), M2 = some(2, 2), S1 = 50 * some(3, 3), S2 = 70 * some(2, 4);
  Vector F = (Vector(5) << 1, -2, 3, 4, -5).finished();
  std::unique_ptr<StructurePart> whole() const {
    auto walls = toys::one_wall(3, 1);
    walls.push_back({.name = "other", .first = 3, .count = 2, .answers = true, .mass = 1, .volume = 0});
    return std::make_unique<Modal>(
        Modal::Made{Matrix::Identity(5, 5), diagonal(M1, M2), diagonal(S1, S2), F, std::move(walls)});
  }
  std::unique_ptr<StructurePart> parts() const {
    std::vector<std::unique_ptr<StructurePart>> both;
    both.push_back(
        std::make_unique<Modal>(Modal::Made{Matrix::Identity(3, 3), M1, S1, F.head(3), toys::one_wall(3, 1)}));
    both.push_back(
        std::make_unique<Modal>(Modal::Made{Matrix::Identity(2, 2), M2, S2, F.tail(2), toys::one_wall(2, 1)}));
    return std::make_unique<Composite>(std::move(both));
  }
};

std::unique_ptr<Water> water() {
  return std::make_unique<Water>(30 * some(5, 9), Matrix::Zero(5, 5), 3 * Matrix::Identity(5, 5),
                                 std::vector<std::size_t>{0, 0, 0, 1, 1});
}

TEST(Composite, moves_as_one_structure_does) {
  const Bodies made;
  auto whole = made.whole(), parts = made.parts();
  const auto &one = *whole, &other = *parts;
  Simultaneous with_one(water(), std::move(whole)), with_parts(water(), std::move(parts));
  ASSERT_EQ(other.walls().size(), 2u);
  EXPECT_EQ(other.walls()[1].first, 3);
  EXPECT_EQ(other.name(), "modal and modal");
  for (int k = 0; k < 20; ++k) {
    ASSERT_TRUE(with_one.attempt(0.01).ok());
    const auto report = with_parts.attempt(0.01);
    ASSERT_TRUE(report.ok()) << report.cause;
    EXPECT_EQ(report.passes, 1);
    with_one.commit();
    with_parts.commit();
    ASSERT_LT((one.velocities() - other.velocities()).norm(), 1e3 * eps * one.velocities().norm()) << k;
  }
  std::stringstream file;
  with_parts.save(file);
  auto again = made.parts();
  const auto& resumed = *again;
  Simultaneous stepper(water(), std::move(again));
  stepper.load(file);
  EXPECT_EQ(resumed.velocities(), other.velocities());
}

/// A part whose contacts are told.
class Touching final : public Modal {
 public:
  Touching(Made made, ClosedContacts contacts) : Modal(std::move(made)), contacts_(std::move(contacts)) {}
  Response response() const override {
    Response all = Modal::response();
    all.contacts = contacts_;
    return all;
  }
  bool update_contacts(const Impulse& impulse) override {
    asked = impulse;
    return false;
  }
  Impulse asked;

 private:
  ClosedContacts contacts_;
};

ClosedContacts of_both(ClosedContacts first, ClosedContacts second) {
  const Bodies made;
  std::vector<std::unique_ptr<StructurePart>> both;
  both.push_back(std::make_unique<Touching>(
      Modal::Made{Matrix::Identity(3, 3), made.M1, made.S1, made.F.head(3), toys::one_wall(3, 1)}, std::move(first)));
  both.push_back(std::make_unique<Touching>(
      Modal::Made{Matrix::Identity(2, 2), made.M2, made.S2, made.F.tail(2), toys::one_wall(2, 1)}, std::move(second)));
  Composite all(std::move(both));
  all.begin({.kick = 0.1, .dt = 0.1});
  return all.response().contacts;
}

TEST(Composite, keeps_contacts_of_a_part_to_that_part) {
  EXPECT_FALSE(of_both({}, {}).restrict_modes());
  const Matrix along = Matrix::Random(3, 2), workless = Matrix::Random(3, 2);
  const Vector known = Vector::Random(3);
  const auto all = of_both({.directions = along, .known = known, .workless = workless}, {});
  EXPECT_EQ(all.directions, diagonal(along, Matrix::Identity(2, 2)));
  EXPECT_EQ(all.workless, diagonal(workless, Matrix::Identity(2, 2)));
  EXPECT_EQ(all.known.head(3), known);
  EXPECT_TRUE(all.known.tail(2).isZero(0));
  // Contacts that leave a part no motion at all, in the second place.
  const auto stuck = of_both({}, {.directions = Matrix(2, 0), .known = Vector::Ones(2)});
  EXPECT_EQ(stuck.directions, Matrix(diagonal(Matrix::Identity(3, 3), Matrix(2, 0))));
  EXPECT_EQ(stuck.workless.size(), 0);
  EXPECT_EQ(stuck.known.tail(2), Vector::Ones(2));
}

TEST(Composite, wants_parts_at_one_time) {
  EXPECT_THROW(Composite({}), std::invalid_argument);
  std::vector<std::unique_ptr<StructurePart>> none(1);
  EXPECT_THROW(Composite(std::move(none)), std::invalid_argument);
}

}  // namespace
}  // namespace splashdown::coupling::composite_test
