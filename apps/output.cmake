# Recorder, summary and report. Uses the headers of fluid and rigid; whoever links it brings their libraries,
# so that tests may bring stand-ins.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(VTK REQUIRED COMPONENTS CommonCore CommonDataModel IOXML)

add_library(splashdown_output STATIC
  ${CMAKE_CURRENT_LIST_DIR}/attitude.cpp
  ${CMAKE_CURRENT_LIST_DIR}/csv.cpp
  ${CMAKE_CURRENT_LIST_DIR}/energy_statistics.cpp
  ${CMAKE_CURRENT_LIST_DIR}/filters.cpp
  ${CMAKE_CURRENT_LIST_DIR}/frames.cpp
  ${CMAKE_CURRENT_LIST_DIR}/gnuplot.cpp
  ${CMAKE_CURRENT_LIST_DIR}/hull_map.cpp
  ${CMAKE_CURRENT_LIST_DIR}/landing_statistics.cpp
  ${CMAKE_CURRENT_LIST_DIR}/plane_picture.cpp
  ${CMAKE_CURRENT_LIST_DIR}/pulse.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder_energy.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder_files.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder_hulls.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder_probes.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder_rows.cpp
  ${CMAKE_CURRENT_LIST_DIR}/recorder_view.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_data.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_field.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_figures.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_html.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_hull.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_page.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_picture.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_study.cpp
  ${CMAKE_CURRENT_LIST_DIR}/report_words.cpp
  ${CMAKE_CURRENT_LIST_DIR}/statistics.cpp
  ${CMAKE_CURRENT_LIST_DIR}/summary.cpp
  ${CMAKE_CURRENT_LIST_DIR}/verdict.cpp
  ${CMAKE_CURRENT_LIST_DIR}/vtu_grid.cpp)
target_compile_features(splashdown_output PUBLIC cxx_std_20)
target_compile_options(splashdown_output PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Werror)
target_precompile_headers(splashdown_output PRIVATE ${SPLASHDOWN_COMMON_HEADERS} <fmt/format.h> <nlohmann/json.hpp>)
target_include_directories(splashdown_output PUBLIC ${CMAKE_CURRENT_LIST_DIR}/..)
target_link_libraries(splashdown_output
  PUBLIC Eigen3::Eigen nlohmann_json::nlohmann_json fmt::fmt
  PRIVATE VTK::CommonCore VTK::CommonDataModel VTK::IOXML)
