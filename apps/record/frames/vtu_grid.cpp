#include "apps/record/frames/vtu_grid.hpp"

#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <stdexcept>

namespace splashdown::apps {

Grid read_grid(const std::filesystem::path& path, const std::string& scalar) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  if (!reader->CanReadFile(path.c_str())) throw std::runtime_error(path.string() + ": is not a readable .vtu file");
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkUnstructuredGrid* data = reader->GetOutput();
  Grid grid;
  if (auto* time = data->GetFieldData()->GetArray("TimeValue")) grid.time = time->GetTuple1(0);
  if (auto* forward = data->GetFieldData()->GetArray("forward")) forward->GetTuple(0, grid.forward.data());
  auto* values = data->GetPointData()->GetArray(scalar.c_str());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i) {
    Point3 x;
    data->GetPoint(i, x.data());
    grid.points.push_back(x);
    grid.values.push_back(values ? values->GetTuple1(i) : 0);
  }
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c) {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    data->GetCellPoints(c, count, ids);
    grid.cells.emplace_back(ids, ids + count);
  }
  return grid;
}

}  // namespace splashdown::apps
