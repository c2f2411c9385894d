# Reads every #include of fluid, rigid, elastic, coupling and apps and fails with the file, the line and the rule that is broken.
#   cmake -DROOT=SOURCE_DIR -P include_rules.cmake
# Rules name files and what they include by regular expressions on paths; a file that a rule is about may not include what the
# rule names.
cmake_minimum_required(VERSION 3.25)

set(rules 0)
# rule(TEXT FILES ... INCLUDES ... [BUT_FILES ...] [BUT_INCLUDES ...])
function(rule text)
  cmake_parse_arguments(PARSE_ARGV 1 r "" "FILES;BUT_FILES;INCLUDES;BUT_INCLUDES" "")
  foreach(field IN ITEMS FILES BUT_FILES INCLUDES BUT_INCLUDES)
    if(NOT DEFINED r_${field})
      set(r_${field} "^$")
    endif()
    set(rule_${rules}_${field} "${r_${field}}" PARENT_SCOPE)
  endforeach()
  set(rule_${rules}_text "${text}" PARENT_SCOPE)
  math(EXPR rules "${rules} + 1")
  set(rules ${rules} PARENT_SCOPE)
endfunction()

# Rooms.
rule("the program is included by nobody else" FILES "^(core|fluid|rigid|elastic|coupling)/" INCLUDES "^apps/")
rule("what all share knows none of them" FILES "^core/" INCLUDES "^(fluid|rigid|elastic|coupling)/")
rule("a fluid knows no bodies" FILES "^fluid/" INCLUDES "^(rigid|elastic)/")
rule("bodies know no fluid" FILES "^rigid/" INCLUDES "^(fluid|elastic)/")
rule("solids that deform know neither fluid nor rigid bodies" FILES "^elastic/" INCLUDES "^(fluid|rigid)/")
rule("coupling says what a fluid and a structure are and includes neither" FILES "^coupling/" INCLUDES "^(fluid|rigid|elastic)/")
rule("of coupling, a fluid and bodies know what they implement, in one file each" FILES "^(fluid|rigid|elastic)/"
  BUT_FILES "^(fluid/(pfem|vortex|ale)|rigid|elastic)/participant\\." INCLUDES "^coupling/")
rule("participants implement the seam, whatever scheme drives them" FILES "^(fluid|rigid|elastic)/" INCLUDES "^coupling/(schemes|accelerators|interface_)")
rule("accelerators see vectors, the slope of a pass is what needs both sides" FILES "^coupling/accelerators/"
  BUT_FILES "/pass_slope\\." INCLUDES "^coupling/" BUT_INCLUDES "^coupling/accelerators/")
rule("schemes and types are chosen in apps/build and apps/effects alone" FILES "^apps/" BUT_FILES "^apps/(build|effects/[a-z_]*)/[a-z_]*\\.cpp$"
  INCLUDES "^((fluid/(pfem|vortex|ale)|rigid|elastic)/participant\\.hpp|fluid/effects/|coupling/)" BUT_INCLUDES "^coupling/schemes/stepper\\.hpp$")

# Rooms within a room.
rule("the particle finite element method and vortices on a grid do not know each other" FILES "^fluid/(pfem|effects)/" INCLUDES "^fluid/vortex/")
rule("vortices on a grid know neither finite elements nor their effects" FILES "^fluid/vortex/" INCLUDES "^fluid/(pfem|effects)/")
rule("a mesh that moves knows neither other fluids nor their effects," FILES "^fluid/ale/" INCLUDES "^fluid/(pfem|vortex|effects)/")
rule("other fluids do not know the mesh that moves" FILES "^fluid/(pfem|vortex|effects)/" INCLUDES "^fluid/ale/")
rule("parts of the fluid on a mesh that moves do not know the whole" FILES "^fluid/ale/.*/" INCLUDES "^fluid/ale/(fluid|participant|spec)\\.hpp")
rule("equations on a mesh that moves know no walls" FILES "^fluid/ale/(equations|linear|mesh)/" INCLUDES "^fluid/ale/walls/")
rule("the grid's parts do not know the whole" FILES "^fluid/vortex/.*/" INCLUDES "^fluid/vortex/(fluid|participant|spec)\\.hpp")
rule("equations on a grid know no bodies" FILES "^fluid/vortex/(poisson|transport)/" INCLUDES "^fluid/vortex/penalised/")
rule("a fluid's parts do not know the whole" FILES "^fluid/(pfem/.*|effects)/" INCLUDES "^fluid/pfem/(fluid|fluid_state|participant)\\.hpp")
rule("what a step is made of knows neither the water as a whole nor the step" FILES "^fluid/(pfem/(contact|initial|linear|mesh|pressure)|effects)/"
  INCLUDES "^fluid/pfem/(water|step)/")
rule("the water does not know what steps it" FILES "^fluid/pfem/water/" INCLUDES "^fluid/pfem/(step/|formulations\\.)")
rule("the frame of a step knows no formulation" FILES "^fluid/pfem/step/[a-z_]*\\." BUT_FILES "^fluid/pfem/step/formulations\\.cpp$"
  INCLUDES "^fluid/pfem/step/[a-z_]*/")
rule("the fractional step knows the frame of a step and no other formulation" FILES "^fluid/pfem/step/fractional/"
  INCLUDES "^fluid/pfem/step/" BUT_INCLUDES "^fluid/pfem/step/(fractional/|(step|trial)\\.hpp$)")
rule("the monolithic formulation knows the frame of a step and no other formulation" FILES "^fluid/pfem/step/monolithic/"
  INCLUDES "^fluid/pfem/step/" BUT_INCLUDES "^fluid/pfem/step/(monolithic/|(step|trial)\\.hpp$)")
rule("the linear algebra knows no water, but for the pattern that cells make" FILES "^fluid/pfem/linear/"
  INCLUDES "^fluid/(pfem/(mesh|initial|contact|pressure)|effects)/" BUT_INCLUDES "^fluid/pfem/mesh/node_cells\\.hpp$")
rule("the mesh knows walls, and nothing of what is solved on it" FILES "^fluid/pfem/mesh/"
  INCLUDES "^fluid/(pfem/(initial|contact|pressure)|effects)/" BUT_INCLUDES "^fluid/pfem/contact/wall\\.hpp$")
rule("the triangulation knows points and facets, and nothing of water" FILES "^fluid/pfem/mesh/delaunay/"
  INCLUDES "^fluid/pfem/mesh/" BUT_INCLUDES "^fluid/pfem/mesh/(delaunay/|mesh\\.hpp$)")
rule("what is liquid is decided without what changes nodes" FILES "^fluid/pfem/mesh/recognition/"
  INCLUDES "^fluid/pfem/mesh/(adapt|conservation|drops|sizes)/")
rule("what the mesh keeps of volume, momentum and energy knows no drops" FILES "^fluid/pfem/mesh/conservation/"
  INCLUDES "^fluid/pfem/mesh/(adapt|drops|sizes)/")
rule("nodes are split and merged by the sizes that they carry" FILES "^fluid/pfem/mesh/adapt/" INCLUDES "^fluid/pfem/mesh/(conservation|drops|sizes)/")
rule("sizes are of places, not of what becomes of nodes there" FILES "^fluid/pfem/mesh/sizes/" INCLUDES "^fluid/pfem/mesh/(adapt|conservation|drops)/")
rule("drops know what they carry, not how the rest is adapted" FILES "^fluid/pfem/mesh/drops/" INCLUDES "^fluid/pfem/mesh/(adapt|sizes)/")
rule("the pressure knows neither contact nor effects" FILES "^fluid/pfem/pressure/" INCLUDES "^fluid/(pfem/(initial|contact)|effects)/")
rule("an effect knows neither contact nor the pressure" FILES "^fluid/effects/" INCLUDES "^fluid/pfem/(initial|contact|pressure)/")
rule("contact hands mass to the pressure and knows nothing else of it" FILES "^fluid/pfem/contact/"
  INCLUDES "^fluid/(pfem/(initial|linear|pressure)|effects)/" BUT_INCLUDES "^fluid/pfem/pressure/held_mass\\.hpp$")
rule("the first mesh is made before anything is solved" FILES "^fluid/pfem/initial/" INCLUDES "^fluid/(pfem/(linear|pressure)|effects)/")
rule("shapes know what a body is, not how it moves" FILES "^rigid/shapes/" INCLUDES "^rigid/"
  BUT_INCLUDES "^rigid/(shapes/|(types|body|embedding|message)\\.hpp$)")
rule("a law knows no mesh" FILES "^elastic/laws/" INCLUDES "^elastic/" BUT_INCLUDES "^elastic/laws/")
rule("a solid's mesh knows nothing of what is solved on it" FILES "^elastic/mesh/" INCLUDES "^elastic/" BUT_INCLUDES "^elastic/mesh/")
rule("what moves a solid in time knows equations, not what they are of" FILES "^elastic/(steps|modes)/" INCLUDES "^elastic/"
  BUT_INCLUDES "^elastic/((steps|modes)/|assembly/system\\.hpp$)")
rule("expressions on results know no run" FILES "^apps/quantity/" INCLUDES "^(apps|fluid|rigid|elastic|coupling)/" BUT_INCLUDES "^apps/quantity/")
rule("of a scene, what is recorded and told knows plain structs" FILES "^apps/(statistics|record|report)/" INCLUDES "^apps/scene/"
  BUT_INCLUDES "^apps/scene/(channel_classes|limit|patch_region)\\.hpp$")

# Layers of the program, from below: a room includes itself and what stands before it.
set(layers quantity text files process scene effects statistics record report render build simulation check new advise run study price ablate sensors cli)
set(below "")
foreach(room IN LISTS layers)
  list(APPEND below ${room})
  list(JOIN below "|" known)
  rule("the layers of apps: ${room} stands below" FILES "^apps/${room}/" INCLUDES "^apps/" BUT_INCLUDES "^apps/(${known})/")
endforeach()
rule("each room of apps has a place among the layers" FILES "^apps/" BUT_FILES "^apps/(${known})/" INCLUDES ".")
rule("what is recorded does not depend on how it is coupled" FILES "^apps/(record|statistics|report)/" INCLUDES "^coupling/")
rule("nodes and mesh are the particle finite element method's own" FILES "^(apps|rigid|coupling)/" INCLUDES "^fluid/pfem/(nodes|mesh/mesh)\\.hpp$")
rule("records look at views, in core, not at who solves" FILES "^apps/(record|statistics|report)/" INCLUDES "^(fluid|rigid)/")

# Libraries, each with one home.
rule("CGAL stays in core/surface, fluid/pfem/mesh/delaunay, fluid/pfem/initial, fluid/ale/mesh and elastic/mesh" FILES "."
  BUT_FILES "^(core/surface/|fluid/pfem/(mesh/delaunay|initial)/|(fluid/ale/mesh/flow|elastic/mesh/(outline|volume))_mesh\\.cpp$)" INCLUDES "^(CGAL|boost)/"
  BUT_INCLUDES "^boost/(math|random)/")
rule("Boost's distributions and sequences stay in apps/price, study/design and study/campaign" FILES "."
  BUT_FILES "^apps/(price|study/(design|campaign))/.*\\.cpp$" INCLUDES "^boost/(math|random)/")
rule("UMFPACK stays in fluid/ale/linear" FILES "." BUT_FILES "^fluid/ale/linear/.*\\.cpp$" INCLUDES "umfpack")
rule("hypre, MPI, SuiteSparse and BLAS stay in fluid/pfem/linear" FILES "." BUT_FILES "^fluid/(pfem|ale)/linear/.*\\.cpp$"
  INCLUDES "^(HYPRE|_hypre|mpi\\.h|suitesparse/|cholmod|omp\\.h|cblas|lapacke)")
rule("threads are started in core/parallel" FILES "." BUT_FILES "^(core/parallel\\.|fluid/)" INCLUDES "^tbb/")
rule("FFTW stays in fluid/vortex/poisson" FILES "." BUT_FILES "^fluid/vortex/poisson/.*\\.cpp$" INCLUDES "^fftw")
rule("Spectra stays in elastic/modes" FILES "." BUT_FILES "^elastic/modes/.*\\.cpp$" INCLUDES "^Spectra/")
rule("Bullet stays in rigid/bullet_engine.cpp" FILES "." BUT_FILES "^rigid/bullet_engine\\.cpp$" INCLUDES "^(bt[A-Z]|[Bb]ullet|BulletDynamics|LinearMath)")
rule("XML and zlib stay in apps/record/frames" FILES "." BUT_FILES "^apps/record/frames/.*\\.cpp$" INCLUDES "^(pugixml|zlib)\\.")
rule("TOML, JSON and archives stay in apps" FILES "." BUT_FILES "^apps/" INCLUDES "^(toml\\+\\+|nlohmann|cereal)/")
rule("the command line is read in apps/cli/main.cpp" FILES "." BUT_FILES "^apps/cli/main\\.cpp$" INCLUDES "^CLI/")
rule("public headers need Eigen and the standard library alone, core/parallel.hpp adds TBB" FILES "^(core|fluid|rigid|elastic|coupling)/.*\\.hpp$"
  BUT_FILES "^(core/(parallel|surface/(sized_triangles|soup))|fluid/pfem/(initial/space_parts|mesh/delaunay/triangulation))\\.hpp$" INCLUDES "[./]"
  BUT_INCLUDES "^(core|fluid|rigid|elastic|coupling|Eigen)/")

# The line of the first inclusion of a header in a file.
function(line_of file header result)
  file(READ ${ROOT}/${file} text)
  string(FIND "${text}" "${header}" at)
  string(SUBSTRING "${text}" 0 ${at} before)
  string(REGEX MATCHALL "\n" ends "${before}")
  list(LENGTH ends line)
  math(EXPR line "${line} + 1")
  set(${result} ${line} PARENT_SCOPE)
endfunction()

set(broken "")
set(inclusions 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/core/*.[ch]pp ${ROOT}/fluid/*.[ch]pp ${ROOT}/rigid/*.[ch]pp ${ROOT}/elastic/*.[ch]pp ${ROOT}/coupling/*.[ch]pp ${ROOT}/apps/*.[ch]pp)
foreach(file IN LISTS files)
  set(about "")  # the rules that are about this file
  math(EXPR last "${rules} - 1")
  foreach(i RANGE ${last})
    if(file MATCHES "${rule_${i}_FILES}" AND NOT file MATCHES "${rule_${i}_BUT_FILES}")
      list(APPEND about ${i})
    endif()
  endforeach()
  file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[^<\"]*([<\"])([^>\"]*)[>\"].*$" "\\1\\2" found "${line}")
    string(SUBSTRING "${found}" 0 1 quote)
    string(SUBSTRING "${found}" 1 -1 header)
    math(EXPR inclusions "${inclusions} + 1")
    set(texts "")
    if(quote STREQUAL "\"" AND NOT header MATCHES "^(core|fluid|rigid|elastic|coupling|apps)/")
      list(APPEND texts "own headers are named from the root")
    endif()
    foreach(i IN LISTS about)
      if(header MATCHES "${rule_${i}_INCLUDES}" AND NOT header MATCHES "${rule_${i}_BUT_INCLUDES}")
        list(APPEND texts "${rule_${i}_text}")
      endif()
    endforeach()
    foreach(text IN LISTS texts)
      line_of(${file} "${quote}${header}" number)
      string(APPEND broken "${file}:${number}: includes ${header}: ${text}\n")
    endforeach()
  endforeach()
endforeach()

# Rooms that are seen at a glance.
set(most_files 25)
set(folders ${files})
list(TRANSFORM folders REPLACE "/[^/]+$" "/")
list(REMOVE_DUPLICATES folders)
foreach(folder IN LISTS folders)
  set(inside ${files})
  list(FILTER inside INCLUDE REGEX "^${folder}[^/]+$")
  list(LENGTH inside count)
  if(count GREATER most_files)
    string(APPEND broken "${folder}: ${count} files, ${most_files} are the most: make rooms of their kind\n")
  endif()
endforeach()

if(inclusions EQUAL 0)
  message(FATAL_ERROR "no #include under ${ROOT}")
endif()
if(broken)
  message(FATAL_ERROR "include rules (docs/extending.md#rooms):\n${broken}")
endif()
list(LENGTH files count)
message(STATUS "${inclusions} inclusions in ${count} files obey ${rules} rules")
