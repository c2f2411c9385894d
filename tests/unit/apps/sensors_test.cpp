// Where sensors tell two states apart.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "apps/sensors/places.hpp"
#include "tests/scratch_folder.hpp"

namespace splashdown::apps::sensors_test {
namespace {

/// Signals on a second; both states begin alike.
SensorCandidate candidate(const std::string& name, double (*reference)(double), double (*other)(double)) {
  SensorCandidate all{name, {}, {}, {}};
  for (int i = 0; i <= 400; ++i) {
    all.times.push_back(i / 400.);
    all.reference.push_back(reference(all.times.back()));
    all.other.push_back(other(all.times.back()));
  }
  return all;
}

double one(double t) { return std::sin(40 * t); }
double louder(double t) { return 1.5 * std::sin(40 * t); }
double loudest(double t) { return 2 * std::sin(40 * t); }
double shifted(double t) { return std::sin(40 * t) + 0.3 * std::cos(40 * t); }

TEST(Sensors, a_second_place_shows_what_the_first_does_not) {
  // The second differs most, the first in the same way, the third otherwise.
  const auto places = rank_places({candidate("a.uy", one, louder), candidate("b.uy", one, loudest),
                                   candidate("c.uy", one, shifted), candidate("d.uy", one, one)},
                                  4);
  EXPECT_EQ(places[1].rank, 1u);
  EXPECT_EQ(places[2].rank, 2u);
  EXPECT_EQ(places[0].rank, 0u) << "nothing new is left";
  EXPECT_EQ(places[3].rank, 0u);
  EXPECT_NEAR(places[0].distance, 0.5, 1e-9);
  EXPECT_NEAR(places[1].distance, 1, 1e-9);
  EXPECT_NEAR(places[1].new_share, 1, 1e-9);
  EXPECT_NEAR(places[2].new_share, 0.3, 0.01) << "a cosine has nothing of a sine, but for the ends of the second";
  EXPECT_EQ(places[3].distance, 0);
}

TEST(Sensors, are_read_from_the_probes_that_both_runs_have) {
  const ScratchFolder folder;
  folder.write("one/probes.csv",
               "time,probe,value\n0,a.uy,0\n0,b.uy,5\n0,a.ux,1\n1,a.uy,2\n1,b.uy,5\n1,a.ux,1\n2,a.uy,4\n");
  folder.write("two/probes.csv", "time,probe,value\n0,a.uy,0\n0.5,a.uy,2\n1.5,a.uy,6\n");
  const auto all = read_candidates(folder.path() / "one", folder.path() / "two", "uy");
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].name, "a.uy");
  EXPECT_EQ(all[0].times, (std::vector<double>{0, 1})) << "as long as both go";
  EXPECT_EQ(all[0].other, (std::vector<double>{0, 4})) << "on the times of the reference";
  EXPECT_THROW(read_candidates(folder.path() / "one", folder.path() / "three", "uy"), std::runtime_error);
  try {
    read_candidates(folder.path() / "one", folder.path() / "two", "vx");
    FAIL() << "there are no velocities";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("kinds ux, uy"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace splashdown::apps::sensors_test
