# Recorder, summary and report. Uses the headers of fluid and rigid; whoever links it brings their libraries,
# so that tests may bring stand-ins.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(pugixml REQUIRED)

set(output_sources
  text/number_text.cpp files/csv.cpp files/run_files.cpp
  record/hulls.cpp record/passes.cpp record/points.cpp record/probes.cpp record/recorder.cpp record/view.cpp
  record/frames/base64.cpp record/frames/frames.cpp record/frames/hull_map.cpp record/frames/vtu.cpp record/frames/vtu_blocks.cpp record/frames/vtu_grid.cpp
  record/sections/section_loads.cpp record/sections/section_mass.cpp record/sections/velocity_lines.cpp
  record/tables/energy.cpp record/tables/evidence.cpp record/tables/rows.cpp
  statistics/attitude.cpp statistics/energy_statistics.cpp statistics/evidence.cpp statistics/foreseen_json.cpp statistics/filters.cpp
  statistics/verdict/grades.cpp statistics/landing_statistics.cpp statistics/verdict/limits.cpp statistics/verdict/missing.cpp statistics/verdict/next_step.cpp
  statistics/pulse.cpp statistics/rise.cpp statistics/verdict/share.cpp statistics/verdict/statements.cpp statistics/statistics.cpp statistics/summary.cpp statistics/verdict/verdict.cpp
  report/data.cpp report/figures.cpp report/curves/acceleration.cpp report/curves/behind.cpp report/curves/charts.cpp report/curves/filtered_curves.cpp report/curves/passes.cpp report/curves/section_figures.cpp report/curves/reduction.cpp report/curves/style.cpp report/gnuplot.cpp report/html.cpp
  report/ablation.cpp report/inputs/hull_views.cpp report/inputs/inputs.cpp report/answers/afloat.cpp report/answers/answers.cpp report/page.cpp report/pairs/pairs.cpp report/price.cpp report/report.cpp report/look/scripts.cpp report/study/study.cpp report/study/campaign.cpp report/study/distributions.cpp report/study/envelopes.cpp report/study/maps.cpp report/look/theme.cpp report/answers/tile.cpp report/words.cpp
  report/replay/mesh_code.cpp report/replay/moving_picture.cpp report/replay/packed_picture.cpp report/replay/replay.cpp
  report/pictures/field.cpp report/pictures/hull.cpp report/pictures/picture.cpp report/pictures/plane_picture.cpp
  report/pictures/png.cpp)
list(TRANSFORM output_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
foreach(file replay.css unpack.js stage.js viewer.js)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/report/replay/${file})
  string(REPLACE . _ name ${file})
  file(READ ${CMAKE_CURRENT_LIST_DIR}/report/replay/${file} ${name})
endforeach()
configure_file(${CMAKE_CURRENT_LIST_DIR}/report/replay/viewer.hpp.in include/apps/report/replay/viewer.hpp @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/report/curves/charts.js ${CMAKE_CURRENT_LIST_DIR}/report/curves/charts.css)
file(READ ${CMAKE_CURRENT_LIST_DIR}/report/curves/charts.js charts)
file(READ ${CMAKE_CURRENT_LIST_DIR}/report/curves/charts.css charts_css)
configure_file(${CMAKE_CURRENT_LIST_DIR}/report/curves/charts_script.hpp.in include/apps/report/curves/charts_script.hpp @ONLY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/report/pairs/pairs.js)
file(READ ${CMAKE_CURRENT_LIST_DIR}/report/pairs/pairs.js pairs)
configure_file(${CMAKE_CURRENT_LIST_DIR}/report/pairs/pairs_script.hpp.in include/apps/report/pairs/pairs_script.hpp @ONLY)
add_library(splashdown_output STATIC ${output_sources})
target_include_directories(splashdown_output PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/include)
target_compile_features(splashdown_output PUBLIC cxx_std_20)
target_include_directories(splashdown_output PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(splashdown_output
  PUBLIC Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt
  PRIVATE splashdown_core splashdown::quantity pugixml::pugixml PNG::PNG ZLIB::ZLIB)
