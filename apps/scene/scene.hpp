// A scene as plain data: what scene.toml says, checked, with every default filled in.
//
// An optional table that is absent is an effect that is absent: there are no switches.
// SI units; angles in degrees where the name says so. Vectors have three entries, the third is zero in
// two-dimensional scenes. Two-dimensional masses and loads are per metre of depth. The last axis of a scene is up.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/scene/kinds/effects.hpp"
#include "apps/scene/limit.hpp"
#include "core/bodies_view.hpp"
#include "rigid/shapes/shapes.hpp"

namespace splashdown::apps {

using Point = Eigen::Vector3d;

// Shapes of bodies, each in its own frame; the reference point is that frame's origin.
struct PolygonShape {
  std::vector<Point> points;  ///< outline, either sense; reference point: the origin of these coordinates
};
struct WedgeShape {
  double deadrise_deg = 30;      ///< of both faces [deg]
  double breadth = 1;            ///< at the top [m]
  std::optional<double> height;  ///< keel to top [m]; absent: no vertical sides, a triangle
};                               ///< reference point: the keel
struct RectangleShape {
  double width = 1, height = 1;  ///< [m]; reference point: the centre
};
struct CircleShape {
  double radius = 1;  ///< [m]; reference point: the centre
};
struct EllipseShape {
  Point semi_axes = Point::Ones();  ///< [m]; reference point: the centre
};
struct CapsuleShape {
  double radius = 1, length = 1;  ///< of the round ends; of the straight part between them, along x [m]
};                                ///< reference point: the centre
struct BoxShape {
  Point size = Point::Ones();  ///< [m]; reference point: the centre
};
struct SphereShape {
  double radius = 1;  ///< [m]; reference point: the centre
};
struct ConeShape {
  double deadrise_deg = 30;  ///< between the horizontal and the side [deg]
  double radius = 1;         ///< of the flat top [m]; reference point: the apex, below
};
struct RevolvedShape {
  std::vector<std::array<double, 2>> profile;  ///< (r, z), turned about the z axis; reference point: r = z = 0
};
struct SplineShape {
  std::vector<Point> points;  ///< of control [m]; in three dimensions (r, z), turned about the z axis
  int degree = 3;
  bool closed = false;   ///< periodic; an open outline is closed by a straight line
  double tolerance = 0;  ///< of the chords [m]; 0: chosen
};                       ///< reference point: the origin of these coordinates
struct SurfaceShape {
  std::string file;                             ///< STL or OBJ, absolute
  double scale = 1;                             ///< metres per unit of the file
  int parts = 1;                                ///< closed surfaces beside each other
  std::shared_ptr<const rigid::Shape<3>> read;  ///< in metres; null: could not be read
};                                              ///< reference point: the origin of the file's coordinates
/// The spline and the capsule exist in two and in three dimensions, the shapes before them in two and those after them in three.
using Shape = std::variant<PolygonShape, WedgeShape, RectangleShape, CircleShape, EllipseShape, SplineShape,
                           CapsuleShape, BoxShape, SphereShape, ConeShape, RevolvedShape, SurfaceShape>;

// Liquid regions, in the world frame.
struct BoxRegion {
  Point min = Point::Zero(), max = Point::Zero();  ///< corners [m]
  double surface_amplitude = 0;                    ///< of a cosine elevation of the top side [m]
  double surface_wavelength = 0;                   ///< [m]; 0: flat
  double surface_phase_deg = 0;  ///< top = max_y + amplitude cos(2 pi (x - min_x) / wavelength + phase)
};
struct CircleRegion {
  Point centre = Point::Zero();
  double radius = 1;
};
struct EllipseRegion {
  Point centre = Point::Zero();
  Point semi_axes = Point::Ones();
};
struct PolygonRegion {
  std::vector<Point> points;
};
struct SphereRegion {
  Point centre = Point::Zero();
  double radius = 1;
};
struct RevolvedRegion {
  RevolvedShape shape;
  Point position = Point::Zero();  ///< of r = z = 0
};
struct SplineRegion {
  SplineShape shape;
  Point position = Point::Zero();  ///< of the origin of its coordinates
};
struct RegionPart;
struct UnionRegion {
  std::vector<RegionPart> parts;
  std::shared_ptr<const Surface<3>>
      whole;  ///< of parts in space, computed when they are read; null: not yet, or impossible
};
using RegionShape = std::variant<BoxRegion, CircleRegion, EllipseRegion, PolygonRegion, SplineRegion, SphereRegion,
                                 RevolvedRegion, UnionRegion>;
/// Of a union; never one itself.
struct RegionPart {
  RegionShape shape;
};

struct Region {
  RegionShape shape;
  Point velocity = Point::Zero();                               ///< at t = 0 [m/s]
  Eigen::Matrix3d velocity_gradient = Eigen::Matrix3d::Zero();  ///< v = velocity + gradient (x - origin) [1/s]
  Point velocity_origin = Point::Zero();  ///< default: the region's centre; 0 for those drawn by points, and unions
};

struct Sizes {
  double refine = 1;           ///< the lengths and shares that a mesh and dt_max were given have been divided by this
  double surface = 0;          ///< at the free surface [m]
  double far = 0;              ///< largest element [m]; default: `surface`
  double growth = 0.15;        ///< dh/dx; the wedges of docs/validation.md use 0.2
  double wetted_fraction = 0;  ///< h at a wall is at least this fraction of its wetted half length
  /// At hollows of the free surface (the root of a jet) h is this fraction of their radius of curvature ...
  std::optional<double> hollow;
  double hollow_min = 0;   ///< ... but not below this [m]; needed with `hollow`
  double curvature = 0.5;  ///< h at a hull over the outline's radius of curvature, at most
  double corner = 1;       ///< h at a hull's corners over what it is on the hull, at most
};

/// Of the monolithic formulation.
struct Monolithic {
  std::string stabilisation = "transient";  ///< or "convective": tau = h/(2 `speed`)
  double speed = 0;                         ///< [m/s]
  double tolerance = 1e-6;                  ///< of what the pressure does to velocities
  std::string scheme = "midpoint";          ///< or "implicit_euler": of first order
};

struct Fluid {
  double density = 1000;                   ///< [kg/m^3]
  std::string formulation = "fractional";  ///< of `formulation_kinds`
  Monolithic monolithic;                   ///< used by that formulation alone
  Sizes size;
  std::vector<Region> regions;
};

/// A fluid on a grid, without a free surface: [fluid] with formulation = "vortex". Plane scenes only.
struct VortexFluid {
  double density = 1000;                 ///< [kg/m^3]
  double viscosity = 0;                  ///< dynamic [Pa s]
  std::string stencil = "fourth_order";  ///< of diffusion: "five_point" | "fourth_order"
  Point min = Point::Zero(),
        max = Point::Zero();  ///< corners of the grid [m]; with a tank they default to a rim around it
  double size = 0;            ///< of a square [m], divided by `refine`
  double refine = 1;
  std::string sides = "free";               ///< of the grid: "free" | "slip"
  std::vector<std::vector<double>> stream;  ///< rows of time, velocity far away [s, m/s]; empty: at rest
  double smoothing = 0;                     ///< of bodies' outlines, half the width in squares; 0.5 where one moves
  std::optional<double> rate;               ///< lambda of the penalty [1/s]; absent: its limit
  int passes = 0;                           ///< that make free bodies rigid; 0: chosen by their slenderness
  std::string kernel = "m6";                ///< that gives particles back to the grid: "m4" | "m6"
  std::string paths = "rk2";                ///< of particles: "rk2" | "rk4"
};

/// A fluid that fills a box between its sides, on a mesh that moves with bodies in it (ALE): [fluid] with formulation = "ale".
/// Plane scenes only.
struct AleFluid {
  /// What a side of the box lets through: "inflow" | "outflow" | "no_slip" | "slip".
  struct Sides {
    std::string left = "inflow", right = "outflow", bottom = "slip", top = "slip";
    /// In the order of their keys.
    std::array<std::string, 4> all() const { return {left, right, bottom, top}; }
  };
  double density = 1000;                           ///< [kg/m^3]
  double viscosity = 0;                            ///< dynamic [Pa s]
  Point min = Point::Zero(), max = Point::Zero();  ///< corners of the box [m]
  Sides sides;
  Point velocity = Point::Zero();             ///< mean over an inflow side [m/s]
  std::string profile = "uniform";            ///< of the inflow: "uniform" | "parabolic"
  double ramp = 0;                            ///< how long the inflow takes to rise from rest [s]
  double far = 0, growth = 0.15, refine = 1;  ///< largest element [m], dh/dx, what sizes are divided by
  double corner = 0.05;                       ///< size at corners that jut into the fluid, over that on the hull
  double hull = 0;                            ///< elements at bodies [m], default: a quarter of `far`
  std::string scheme = "midpoint";            ///< "midpoint" | "shifted" | "implicit_euler" | "steady"
  double shift = 0.01;                        ///< of "shifted": theta - 1/2
  double tolerance = 1e-8;                    ///< of Newton's method, relative
  int max_iterations = 30;
  std::string extension = "laplace";  ///< of walls' motions to nodes: "laplace" | "biharmonic"
  std::string remesh = "automatic";   ///< a new mesh where bodies have moved theirs too far: "automatic" | "never"
  /// The load on a body along an axis, whose error is told.
  struct Goal {
    std::string body, direction = "x";
  };
  std::vector<Goal> goals;
  int adapt = 0;  ///< how often the mesh is refined for them before the run
};

struct Tank {
  Point min = Point::Zero(), max = Point::Zero();  ///< corners [m]
  double size = 0;                                 ///< element size at the walls [m]; default: fluid.size.far
};

struct Gravity {
  Point acceleration = {0, -9.81, 0};  ///< [m/s^2]; of the standard in three dimensions: {0, 0, -9.81}
};

enum class Motion { free, fixed, prescribed };

/// Shape frame to world, about the shape's reference point. In two dimensions a turn by `pitch_deg`, counter-clockwise;
/// in three R = Rz(heading) Ry(-pitch) Rx(roll): heading counter-clockwise from above, nose (x) up, roll about x.
struct Attitude {
  double heading_deg = 0, pitch_deg = 0, roll_deg = 0;  ///< [deg]
};

/// A pose on a prescribed path: piecewise linear in time, angle by angle.
struct Waypoint {
  double time = 0;                 ///< [s]
  Point position = Point::Zero();  ///< of the shape's reference point [m]
  Attitude attitude;
};

/// Prescribed motion about a mean place, harmonic in time: x + amplitude sin(2 pi f t + phase), the pitch likewise.
struct Oscillation {
  double frequency = 0;                 ///< [Hz]
  Point amplitude = Point::Zero();      ///< of the shape's reference point [m]
  double phase_deg = 0;                 ///< of translation
  double pitch_deg = 0;                 ///< amplitude of the pitch
  double pitch_phase_deg = 0;           ///< of the pitch
  Point centre = Point::Zero();         ///< mean place of the reference point [m]
  Attitude attitude;                    ///< mean
  Waypoint at(double time) const;       ///< pose at a time [s]
  Waypoint rate_at(double time) const;  ///< its derivative [m/s, deg/s]
};

/// Freedoms of free motion: translations along and rotations about the world's axes.
inline std::vector<std::string> freedom_names(int dimension) {
  if (dimension == 2) return {"x", "y", "rotation"};
  return {"x", "y", "z", "roll", "pitch", "yaw"};
}

/// Of a free body of which the scene says that it has no mass, over the fluid's: nothing that loads or motions of bodies in water show.
inline constexpr double least_density = 1e-4;

/// Mass, its centre in the shape's frame, and inertia about it in axes of that frame: in two dimensions the last entry alone.
struct WholeMass {
  double mass = 0;
  Point centre = Point::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

struct Body {
  std::string name;
  Shape shape;
  std::optional<double> mass;           ///< [kg, kg/m]; exactly one of mass and density for free motion
  std::optional<double> density;        ///< mean density [kg/m^3]
  bool without_mass = false;            ///< the scene says 0; free in a fluid it has least_density then
  bool deforms = false;                 ///< it has [body.elastic]
  double refine = 1;                    ///< what the size of its elements is divided by, if it deforms
  std::optional<Point> centre_of_mass;  ///< in the shape's frame [m]; default: the centroid
  /// About the centre of mass, axes of the shape's frame [kg m^2]; default: of uniform density. In two dimensions the
  /// last entry alone [kg m].
  std::optional<Eigen::Matrix3d> inertia;
  std::optional<WholeMass> whole;  ///< known where parts or point masses of [body.elastic] make it other than uniform
  Motion motion = Motion::free;
  std::vector<std::string> free = freedom_names(2);
  Point position = Point::Zero();          ///< of the shape's reference point at t = 0 [m]
  Attitude attitude;                       ///< at t = 0
  Point velocity = Point::Zero();          ///< of the centre of mass at t = 0; constant if prescribed [m/s]
  Point spin_deg = Point::Zero();          ///< angular velocity at t = 0, world frame; constant if prescribed [deg/s]
  std::vector<Waypoint> path;              ///< prescribed motion; empty: constant velocity and spin
  std::optional<Oscillation> oscillation;  ///< prescribed motion; `path` then has points of it, for who looks ahead
  std::optional<Release> release;          ///< of prescribed motion; free from then on
  double size = 0;                         ///< element size at the hull [m]; default: fluid.size.surface
  bool makes_waves = false;  ///< the paddle of [wavemaker]: a part of the tank, whose loads nobody asks about

  /// Forces move it, from the start or after its release.
  bool becomes_free() const { return motion == Motion::free || release; }
};

/// Ties a body to another one or to the world.
struct Joint {
  std::string type = "hinge";  ///< "hinge" | "slider" | "weld"
  std::size_t body = 0;
  std::optional<std::size_t> other;  ///< absent: the world
  Point point = Point::Zero();       ///< world frame, at t = 0 [m]
  Point axis = Point::UnitZ();       ///< of a slider or a hinge, world frame, at t = 0
  // Of how far it has moved since t = 0 [slider: m, hinge: deg]
  std::vector<double> limits;  ///< lowest and highest; empty: none
  double rest = 0;             ///< where its spring is relaxed
  double stiffness = 0;        ///< [slider: N/m, hinge: N m/rad; 2D: for each metre of depth]
  double damping = 0;          ///< [slider: N s/m, hinge: N m s/rad; 2D: the same]
};

/// Present: bodies touch each other and the tank.
struct Contact {
  double friction = 0;     ///< tangential over normal impulse, at most
  double restitution = 0;  ///< speed of leaving over speed of approach
};

struct Coupling {
  std::string scheme = "iterated";       ///< "iterated" | "staggered"
  std::string interface_term = "rigid";  ///< "rigid" | "laplacian" | "robin" | "none"
  std::string accelerator = "constant";  ///< "constant" | "aitken" | "anderson" | "broyden" | "iqn_ils" | "probe"
  double relaxation = 1;                 ///< only (constant, anderson) or first factor, in (0, 1]
  int depth = 50;                        ///< passes that anderson remembers
  int reuse = 0;                         ///< past steps that iqn_ils learns from
  double tolerance = 1e-8;               ///< of the interface velocities, relative
  int max_passes = 50;                   ///< more: the step is refused
};

struct Time {
  double end = 0;     ///< [s]
  double cfl = 0.5;   ///< share of an edge by which its ends may approach in one step
  double dt_max = 0;  ///< [s]; default: cfl sqrt(h_min / |g|), without gravity or fluid end / 100
};

struct Output {
  double interval = 0;           ///< between rows of the csv files [s]; 0: every step
  std::optional<double> frames;  ///< between frames [s]; absent: none
  double checkpoint = 60;        ///< wall seconds between checkpoints
};

// Things to record besides the standard files. Points given with a body are in its shape's frame and
// move with it; others are in the world frame and stay.
struct PressureEntry {
  std::string name;
  Point point = Point::Zero();
  std::optional<std::size_t> body;
};
struct SurfacePressureEntry {
  std::string wall;                ///< name of a body, or "tank"
  std::optional<double> interval;  ///< [s]; 0: every step
  std::vector<double> times;       ///< first step at or after each [s]
};
struct ElevationEntry {
  std::string name;
  double x = 0, y = 0;  ///< horizontal place [m]; y in three dimensions only
};
/// Mean pressure on a part of a hull: a disc around `centre`, or what is between `min` and `max`; shape's frame [m].
struct PatchEntry {
  std::string name;
  std::size_t body = 0;
  std::optional<Point> centre;
  std::optional<double> radius;
  std::optional<Point> min, max;
};
/// The highest pressure of the run all over a hull.
struct MaximumPressureEntry {
  std::size_t body = 0;
  double size = 0;  ///< distance of the points [m]; default: that of the elements at the hull
};
struct AccelerationEntry {
  std::string name;
  std::size_t body = 0;
  Point point = Point::Zero();  ///< in the shape's frame
};
struct AddedMassEntry {
  std::size_t body = 0;
  std::optional<double> interval;  ///< [s]; 0: every step
  std::vector<double> times;       ///< first step at or after each [s]
};
/// The residual of each pass of the coupling.
struct PassesEntry {
  std::optional<double> interval;  ///< [s]; 0: every step
  std::vector<double> times;       ///< first step at or after each [s]
};
/// Loads between the parts of a body at sections across an axis; shape's frame.
struct SectionEntry {
  struct Part {
    double mass = 0;              ///< [kg, kg/m]
    Point point = Point::Zero();  ///< [m]
  };
  std::string name;
  std::size_t body = 0;
  int axis = 0;                  ///< 0: x
  std::vector<double> stations;  ///< along the axis [m]; empty: `sections` equal parts of the hull
  int sections = 20;
  std::vector<Part> parts;         ///< heavy parts; the rest of the mass fills the hull
  std::optional<double> interval;  ///< [s]; 0: every step
  std::vector<double> times;       ///< first step at or after each [s]
};
/// Velocity of the fluid at points on a straight line that stays in place.
struct VelocityLineEntry {
  std::string name;
  Point from = Point::Zero(), to = Point::Zero();
  int points = 50;                 ///< equally far from each other, ends included
  std::optional<double> interval;  ///< [s]; 0: every step
  std::vector<double> times;       ///< first step at or after each [s]
};
using RecordEntry = std::variant<PressureEntry, SurfacePressureEntry, ElevationEntry, AccelerationEntry, AddedMassEntry,
                                 PatchEntry, MaximumPressureEntry, PassesEntry, SectionEntry, VelocityLineEntry>;

struct Scene {
  int dimension = 2;
  std::string title;
  Time time;
  std::optional<Fluid> fluid;         ///< a liquid with a free surface, by particle finite elements
  std::optional<VortexFluid> vortex;  ///< a fluid on a grid
  std::optional<AleFluid> ale;  ///< a fluid on a mesh that moves with bodies; there is never more than one of the three
  std::optional<Tank> tank;
  std::optional<Gravity> gravity;
  Effects effects;  ///< tables of all others
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::optional<Contact> contact;
  std::optional<Coupling> coupling;  ///< present whenever a free body meets a fluid
  Output output;
  std::vector<RecordEntry> records;
  std::vector<Limit> limits;  ///< of records, and those that stand alone

  /// Whether there is a fluid of any formulation.
  bool has_fluid() const { return fluid || vortex || ale; }
  /// Of the fluid there is [kg/m^3]; 0: there is none.
  double fluid_density() const { return fluid ? fluid->density : vortex ? vortex->density : ale ? ale->density : 0; }
};

}  // namespace splashdown::apps
