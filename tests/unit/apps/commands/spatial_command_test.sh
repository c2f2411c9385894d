#!/usr/bin/env bash
# The command in three dimensions: a flight from file to report, what check says, hulls from files that are none.
#   spatial_command_test.sh PATH_OF_SPLASHDOWN
. "$(dirname "${BASH_SOURCE[0]}")/checks.sh"

cat >flight.toml <<'SCENE'
dimension = 3
[time]
end = 0.5
dt_max = 0.005
[gravity]
[[body]]
name = "brick"
shape = { type = "box", size = [0.3, 0.2, 0.1] }
density = 500
velocity = [3, 0, 4]
spin_deg = [10, 600, 20]
[output]
frames = 0.1
[[record]]
kind = "acceleration"
name = "corner"
body = "brick"
point = [0.15, 0.1, 0.05]
SCENE

check "a body tumbles through the air" exits 0 "$splashdown" run flight.toml --quiet --out flight
for file in scene.resolved.toml summary.json bodies.csv probes.csv frames.pvd report.html; do
  check "it leaves $file" test -s "flight/$file"
done
check "the resolved scene makes the same run" exits 0 "$splashdown" run flight/scene.resolved.toml --quiet --out again
check "bit for bit" cmp flight/bodies.csv again/bodies.csv
check "a stopped flight" exits 0 "$splashdown" run flight.toml --until 0.2 --quiet --out parts
check "continues" exits 0 "$splashdown" run flight.toml --resume --quiet --out parts
check "to the same bits" cmp flight/bodies.csv parts/bodies.csv

cat >afloat.toml <<'SCENE'
dimension = 3
[time]
end = 1
[gravity]
[tank]
min = [-2, -2, -1]
max = [2, 2, 1]
[fluid]
density = 1000
[fluid.size]
surface = 0.1
[[fluid.region]]
shape = "box"
min = [-2, -2, -1]
max = [2, 2, 0]
[[body]]
name = "raft"
shape = { type = "box", size = [1, 0.5, 0.3] }
density = 400
position = [0, 0, 0.3]
roll_deg = 20
SCENE
check "check says how a body floats" exits 0 "$splashdown" check afloat.toml
# GM = T/2 + B^2/(12 T) - H/2 with T = 0.12 m and B = 0.5 m, 1 m.
check "with its draft and attitude" grep -q 'draft of 0.12 m, heel (roll) 0 deg, trim (pitch) 0 deg' stdout
check "its metacentric heights" grep -q 'GM 0.08361 m in roll, 0.6044 m in pitch' stdout
check "and its righting levers" grep -Eq '^ +180 ' stdout

# Of a sphere GZ is sin(heel) times the distance of its centre from that of mass, whatever becomes of its trim.
cat >buoy.toml <<'SCENE'
dimension = 3
[time]
end = 1
[gravity]
[tank]
min = [-2, -2, -2]
max = [2, 2, 2]
[fluid]
density = 1000
[[fluid.region]]
shape = "box"
min = [-2, -2, -2]
max = [2, 2, 0]
[[body]]
name = "buoy"
shape = {type = "sphere", radius = 0.5}
density = 400
centre_of_mass = [0, 0, -0.1]
SCENE
check "check follows the heel of a sphere" exits 0 "$splashdown" check buoy.toml
check "beyond 90 degrees" grep -Eq '^ +120 +0.0866 ' stdout
check "to 180" grep -Eq '^ +180 +0.0000 ' stdout
check "and says where its trim is not stable" grep -q 'beyond 90 deg its trim is balanced, but not stable' stdout

cat >ball.toml <<'SCENE'
dimension = 3
[time]
end = 0.05
[gravity]
[tank]
min = [-0.6, -0.6, -0.5]
max = [0.6, 0.6, 0.5]
[fluid]
density = 1000
[fluid.size]
surface = 0.08
far = 0.12
[[fluid.region]]
shape = "box"
min = [-0.6, -0.6, -0.5]
max = [0.6, 0.6, 0]
[[body]]
name = "ball"
shape = { type = "sphere", radius = 0.2 }
density = 300
position = [0, 0, 0.21]
velocity = [0.5, 0, -2]
size = 0.05
SCENE
# The users' environment must not matter: BLAS reads its own number of threads from there.
check "a ball falls on water" exits 0 env OPENBLAS_NUM_THREADS=3 "$splashdown" run ball.toml --quiet --threads 1 --out ball_1
for threads in 2 4; do
  check "on $threads threads" exits 0 "$splashdown" run ball.toml --quiet --threads $threads --out "ball_$threads"
  check "to the same bits" cmp ball_1/bodies.csv "ball_$threads/bodies.csv"
  check "in the water, too" cmp <(simulated ball_1/fluid.csv) <(simulated "ball_$threads/fluid.csv")
done

broken() {  # broken NAME WHAT_IS_SAID: the file is refused with this text
  exits 2 "$splashdown" check afloat.toml --set "body.raft.shape={type=\"surface\", file=\"$1\"}" && grep -q "$2" stderr
}
tetrahedron='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n'
printf "${tetrahedron}f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n" >good.obj
printf "${tetrahedron}f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n" >inverted.obj
printf "${tetrahedron}v 5 5 5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 5\n" >open.obj
printf 'solid\nfacet normal 0 0 1\nouter loop\nvertex 0,5 0 0\n' >comma.stl
printf '%80s\200\226\230\000' '' >fine.stl # 10 million facets, little endian
truncate -s 500000084 fine.stl
check "a whole hull is good" exits 0 "$splashdown" check afloat.toml --set 'body.raft.shape={type="surface", file="good.obj", scale=0.5}'
check "an inverted one is refused" broken inverted.obj 'is inside out: all its normals point inward. Flip it'
check "an open one" broken open.obj 'body.raft.shape.file = "open.obj": is not closed: 1 hole, around .* Close it'
check "one that is no mesh" broken comma.stl "line 4, 'vertex 0,5 0 0', is no line of STL"
check "one that is too fine, at once" broken fine.stl 'has 10000000 facets; 1000000 are the most'

verdict
