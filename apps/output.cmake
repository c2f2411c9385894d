# Recorder, summary and report. Uses the headers of fluid and rigid; whoever links it brings their libraries,
# so that tests may bring stand-ins.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PNG REQUIRED)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML)

set(output_sources
  record/csv.cpp record/energy.cpp record/evidence.cpp record/files.cpp record/frames.cpp record/hull_map.cpp record/hulls.cpp
  record/probes.cpp record/recorder.cpp record/rows.cpp record/view.cpp record/vtu_grid.cpp
  statistics/attitude.cpp statistics/energy_statistics.cpp statistics/evidence.cpp statistics/filters.cpp
  statistics/grades.cpp statistics/landing_statistics.cpp
  statistics/pulse.cpp statistics/statistics.cpp statistics/summary.cpp statistics/verdict.cpp
  report/data.cpp report/field.cpp report/figures.cpp report/gnuplot.cpp report/html.cpp report/hull.cpp
  report/page.cpp report/picture.cpp report/plane_picture.cpp report/price.cpp report/report.cpp report/study.cpp report/words.cpp
  report/png.cpp)
list(TRANSFORM output_sources PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
add_library(splashdown_output STATIC ${output_sources})
target_compile_features(splashdown_output PUBLIC cxx_std_20)
target_include_directories(splashdown_output PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(splashdown_output
  PUBLIC Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt
  PRIVATE splashdown_core VTK::CommonCore VTK::CommonDataModel VTK::IOXML PNG::PNG)
