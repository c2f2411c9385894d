// summary.json: how a run ended and what it measured, one object per run.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/statistics/foreseen.hpp"

namespace splashdown::apps {

inline constexpr double standard_gravity = 9.80665;  ///< [m/s^2], CGPM 1901: one g

/// A largest value and when it happened; nothing happened while `time` is negative.
struct Peak {
  double value = 0;
  double time = -1;
  /// True if `v` is the new peak.
  bool offer(double v, double t);
};

/// How far a result may be trusted, the worse the later.
enum class Grade { resolved, doubtful, unresolved, unphysical };
const char* name_of(Grade grade);

/// Of a run or of a body (verdict.hpp).
struct Verdict {
  Grade grade = Grade::resolved;
  std::vector<std::string> reasons;  ///< sentences: what, how much, what to do; what did not happen comes first
  std::vector<std::string> about;    ///< what the grade is of: the headline numbers with their bands
  std::vector<std::string> notes;    ///< those of the reasons that leave the grade as it is
  /// In plain words (statements.hpp): each headline number, and the water, is in one of the first two.
  std::vector<std::string> trusted, doubted;
  std::vector<std::string> advice;   ///< of the findings; what a run is advised has `next`, too (advice_of)
  std::vector<std::string> because;  ///< shortened: what `doubted` does not say
};

/// What the steps around a peak say about it (evidence.hpp); nan: nothing.
struct Evidence {
  double elements = std::numeric_limits<double>::quiet_NaN();  ///< on half of the wetted width
  double growing = std::numeric_limits<double>::quiet_NaN();   ///< share of the wetted width that is new
  double repair = std::numeric_limits<double>::quiet_NaN();    ///< share of the load that came as repair impulses
  double step = std::numeric_limits<double>::quiet_NaN();      ///< deviation from the steps around it, relative
  double sideways = std::numeric_limits<double>::quiet_NaN();  ///< load that symmetry forbids, over the load
  double pressed = std::numeric_limits<double>::quiet_NaN();   ///< elements on half of the width of a patch
  double sampling = std::numeric_limits<double>::quiet_NaN();  ///< what steps too long for the filter's class take
  double stress = std::numeric_limits<double>::quiet_NaN();    ///< by which a solid's elements disagree, relative
};

/// Independent errors that make a band, relative.
struct BandParts {
  double mesh = 0, step = 0, sampling = 0, rest = 0;
};

/// Of one number (grades.hpp).
struct NumberGrade {
  Grade grade = Grade::resolved;
  double band = 0;  ///< relative, to either side
  BandParts parts;
  std::vector<std::string> reasons;
  std::vector<std::string> causes;  ///< the same in plain words, the largest first
  Evidence evidence;
};

/// Of a pulse, raw and in the classes that it has.
struct PulseGrades {
  std::optional<NumberGrade> raw;
  std::map<int, NumberGrade> cfc;
};

struct RangeCount {
  long initial = 0, max = 0, final = 0;
};

struct ActiveEffect {
  std::string name;
  double seconds = 0;
  std::string reason = {};  ///< the number that says when it matters
};

struct InactiveEffect {
  std::string name, reason;
};

/// A peak with the pulse around it (pulse.hpp); nan: the record does not show it.
struct Pulse : Peak {
  double begin = std::numeric_limits<double>::quiet_NaN();      ///< last passage of 10 % of the peak before it [s]
  double rise_time = std::numeric_limits<double>::quiet_NaN();  ///< from 10 to 90 % of the peak [s]
  double duration = std::numeric_limits<double>::quiet_NaN();   ///< above 10 % of the peak [s]
  double change = std::numeric_limits<double>::quiet_NaN();     ///< integral over the duration [m/s, N s]
};

struct PulseSummary {
  Pulse raw;
  std::map<int, Pulse> cfc;  ///< channel frequency class -> pulse of the filtered channels
};

/// An angle of a body [deg].
struct AngleSummary {
  double end = 0;
  Peak lowest, highest;  ///< since first contact
};

/// What became of a body on the water (landing_statistics.hpp). Times [s] are negative for what did not happen.
struct LandingSummary {
  double first_contact = -1;                                   ///< first wetting
  std::vector<std::pair<std::string, AngleSummary>> attitude;  ///< 2D: pitch alone
  Peak maximum_tilt;                                           ///< since first contact [deg]
  double capsized_since = -1;                                  ///< over until the end of the record
  double settled = -1;
  double settled_below = 0, settled_window = 0;  ///< speed [m/s] and time [s] that `settled` asks for
  double height =
      std::numeric_limits<double>::quiet_NaN();      ///< of the lowest point above the water's level, at the end [m]
  double sinking = 0;                                ///< speed downward of the centre of mass, at the end [m/s]
  std::vector<std::array<double, 2>> dry_intervals;  ///< after first contact; the last may have no end
};

struct MaximumPressure {
  Peak peak;                  ///< [Pa]
  std::vector<double> point;  ///< in the frame of the body's shape [m]
  Evidence evidence;
};

/// The largest von Mises stress of a body that deforms.
struct StressSummary {
  Peak peak;                  ///< [Pa]
  std::vector<double> point;  ///< in the undeformed body at t = 0, world frame [m]
  std::string part = {};      ///< name of its part there; empty: none
  Evidence evidence;
  std::optional<NumberGrade> grade;
};

struct PatchSummary {
  Peak pressure;                           ///< mean over the patch [Pa]
  double impulse = 0, impulse_repair = 0;  ///< time integral of that mean, repairs included; of what they add [Pa s]
  double area = 0;                         ///< [m, m^2]
  std::string body;
  Evidence evidence;
  std::optional<NumberGrade> grade;
};

/// The largest load at a section of a body over all steps.
struct SectionPeak {
  double value = 0, time = -1, station = 0;  ///< [N, N m], [s], along the axis in the frame of the shape [m]
};
struct SectionSummary {
  std::string body;
  std::string axis;                     ///< "x"
  SectionPeak shear, hogging, sagging;  ///< largest magnitude; largest bending moment of either sign
};

/// Of a probe of pressure.
struct PointSummary {
  Peak pressure;     ///< [Pa]
  std::string body;  ///< that it moves with; empty: of a place
  Evidence evidence;
  std::optional<NumberGrade> grade;
};

/// An instrument: the acceleration of a point of a body; peaks [g].
struct EquipmentSummary : PulseSummary {
  std::string body;
  PulseGrades grades;  ///< first with the evidence alone, then graded (grades.hpp)
};

/// What a run says to a limit (limits.hpp); nan: nothing.
struct LimitAnswer {
  std::string name, quantity, unit;
  bool above = true;  ///< what was asked; if not: below
  double limit = 0;   ///< [unit]
  std::string answer;
  double value = std::numeric_limits<double>::quiet_NaN();  ///< [unit]
  double band = std::numeric_limits<double>::quiet_NaN();   ///< to either side [unit]
  int runs = 0;                                             ///< whose mean it goes by; 0: the run's own number
  std::string reason;                                       ///< why it is neither yes nor no; empty: the band
};

struct BodySummary {
  PulseSummary acceleration;           ///< of the centre of mass; peaks [g]
  PulseSummary force;                  ///< of the fluid's total load [N, N/m]
  std::vector<double> impulse;         ///< integral of the total load, x y (z) [N s]
  std::vector<double> impulse_repair;  ///< the part of it from repair impulses
  double impulse_to_and_fro = 0;       ///< integral of the load's magnitude [N s]
  bool rising = false;                 ///< the load still grows when the record ends (rise.hpp)
  Peak submergence;                    ///< still-water level minus lowest point [m]
  Peak wetted;                         ///< wetted length or area [m, m^2]
  LandingSummary landing;
  std::optional<MaximumPressure> maximum_pressure;  ///< if a record asks for it
  std::optional<StressSummary> stress;              ///< of bodies that deform
  double inertial = 1;  ///< |m a| over the load at the largest load, 1 for bodies that are not free
  PulseGrades acceleration_grades, force_grades;  ///< first with the evidence alone, then graded (grades.hpp)
  std::optional<NumberGrade> maximum_pressure_grade;
  Grade of_water = Grade::resolved;  ///< what the water's energy and volume leave to its numbers
  double fastest = 0;                ///< any point of the hull, at most [m/s]
  double held_against =
      0;  ///< mean force that a free body did not follow though nothing showed it why; 0: none (held.hpp)
  Verdict verdict;
};

struct LedgerSummary {
  double volume_initial = 0, volume_final = 0, volume_error = 0;  ///< the last one relative
  double volume_of_effects = 0;                                   ///< that effects brought in on purpose; not written
  /// Gained or lost, spray included [m^2, m^3].
  double volume_excess() const { return volume_final + spray - volume_initial - volume_of_effects; }
  std::optional<double> volume_error_bodies;  ///< the same change over the volume of the hulls; absent without bodies
  double returned_share = 0;  ///< `returned` over the volume of the hulls, or over the water if that is less
  double time_integration = 0, remesh_created = 0, remesh_deleted = 0, returned = 0, spray = 0;
  double kinetic_energy = 0, potential_energy = 0;
  double energy_remesh = 0, energy_repair = 0, work_on_walls = 0;
  double energy_gain = 0;  ///< largest gain that nothing explains, over `energy_scale` (energy_statistics.hpp)
  double energy_gain_joule = 0, energy_gain_time = -1;  ///< the same [J, J/m], and when [s]
  double energy_gain_since = -1;                        ///< when the gain was lowest before that [s]
  double energy_scale = 0;                              ///< what there was to give or to take [J, J/m]
  std::string energy_scale_from;                        ///< what sets it
  double kinetic_deficit = 0;                           ///< lowest kinetic energy below 0, over `energy_scale`
};

/// A number with the error that the mesh leaves in it (core/goals/goal.hpp).
struct GoalSummary {
  std::string name;
  double value = 0, error = 0;  ///< value minus truth
  std::string unit;
};

struct FluidSummary {
  double max_speed = 0;                               ///< of all nodes, at the end [m/s]
  double max_speed_peak = 0;                          ///< at any time
  std::optional<long> remeshings, remeshings_missed;  ///< of a mesh that moves: new ones, wanted ones that were not had
};

struct CouplingSummary {
  std::string scheme, interface_term;
  double passes_mean = 0;
  int passes_max = 0;
  long rejected_steps = 0;
  std::map<std::string, long> rejected_causes;
};

/// What would make a verdict better (next_step.hpp); 0: left as it is.
struct NextStep {
  double refine = 0;  ///< what sizes are divided by: times that of the run, of a whole command that of the command line
  double dt_max = 0;  ///< [s], likewise
  double end = 0;     ///< [s]
  double seconds = 0;     ///< of wall time
  bool promises = false;  ///< a better grade
  std::string effect;     ///< what comes of it, or may not
  std::string command;    ///< whole; empty: the options alone are told
};

/// What a scene asks for, against which is held what happened (missing.hpp).
struct Expectations {
  struct Body {
    bool free = true, moves = true;
    double length = 0;              ///< largest extent of the hull [m]; 0: not known
    std::vector<std::string> tied;  ///< bodies that joints tie to it, whatever is between
  };
  std::map<std::string, Body> bodies;
  bool contact = false;     ///< bodies may carry each other
  double end = 0;           ///< [s]
  double gravity = 0;       ///< downward [m/s^2]
  double path_ends_at = 0;  ///< the last waypoint of all paths [s]; 0: no path
};

struct Summary {
  std::string scene;    ///< name of the scene, for headings
  std::string command;  ///< that made the run; empty: not known
  std::string status;   ///< "done", "failed" or "interrupted" (by a signal or a spent budget)
  std::string cause;    ///< why it failed; empty otherwise
  std::string cure;     ///< what helps against that cause where smaller steps and elements do not; empty: they may
  Verdict verdict;
  int dimension = 2;
  double simulated_time = 0;  ///< [s]
  long steps = 0;
  double wall_seconds = 0;
  double processor_seconds = 0;
  double memory_mb = 0;         ///< largest resident set of the process
  long rejected_steps = 0;      ///< attempts that were refused and repeated with half of dt
  long released_fragments = 0;  ///< nodes that flew on as drops since no smaller dt helped
  std::map<std::string, long> rejected_causes;
  std::vector<std::pair<std::string, double>> phases;  ///< seconds each
  std::vector<ActiveEffect> effects;
  std::vector<InactiveEffect> inactive_effects;
  std::map<std::string, Foreseen> foreseen;   ///< by body
  std::vector<std::string> not_foreseen;      ///< of it, what could not be computed, and why
  std::optional<StillWater> still_water;      ///< absent: no water, or no gravity that points down
  std::optional<RangeCount> nodes, elements;  ///< of a fluid, without one of bodies that deform
  std::optional<CouplingSummary> coupling;    ///< absent unless fluid and bodies are coupled
  std::optional<LedgerSummary> ledger;
  std::optional<FluidSummary> fluid;
  std::vector<GoalSummary> goals;
  std::map<std::string, BodySummary> bodies;
  std::map<std::string, EquipmentSummary> equipment;
  std::map<std::string, PatchSummary> patches;
  std::map<std::string, PointSummary> probes;
  std::map<std::string, SectionSummary> sections;
  std::vector<LimitAnswer> limits;
  std::optional<NextStep> next;          ///< absent: every headline is resolved, or nothing is known that helps
  std::optional<Expectations> expected;  ///< absent: not known
  std::size_t wettable_records = 0;
  std::vector<std::string> dry_records;  ///< of these: probes, gauges and patches that met no water
};

std::string to_json(const Summary& summary);
/// The entry of a limit in it.
nlohmann::ordered_json json_of(const LimitAnswer& limit);
/// Writes DIR/summary.json, whole or not at all.
void write_summary(const std::filesystem::path& directory, const Summary& summary);

}  // namespace splashdown::apps
