#include "middles.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "places.hpp"
#include "solid_cells.hpp"

namespace tetlod_vtk {
namespace {

using Triangle = std::array<vtkIdType, 3>;

bool has_middle(vtkUnstructuredGrid &grid, vtkIdType cell) {
  const int type = grid.GetCellType(cell);
  return (type == VTK_POLYHEDRON || type == VTK_PENTAGONAL_PRISM || type == VTK_HEXAGONAL_PRISM) &&
         !is_ghost(grid, cell);
}

vtkIdType count_middles(vtkUnstructuredGrid &grid) {
  vtkIdType count = 0;
  for (vtkIdType c = 0; c < grid.GetNumberOfCells(); c++) count += has_middle(grid, c);
  return count;
}

class Cutting {
 public:
  explicit Cutting(vtkUnstructuredGrid &from) : from_(from), places_(from) {
    const vtkIdType points = from.GetNumberOfPoints(), cells = from.GetNumberOfCells();
    vtkNew<vtkPoints> room;
    room->SetDataType(from.GetPoints()->GetDataType());
    room->SetNumberOfPoints(points);
    for (vtkIdType v = 0; v < points; v++) room->SetPoint(v, from.GetPoint(v));
    to_->SetPoints(room);
    to_->GetPointData()->DeepCopy(from.GetPointData());
    to_->GetCellData()->CopyAllOn();
    to_->GetCellData()->CopyAllocate(from.GetCellData(), cells);
    to_->Allocate(cells);
  }

  vtkSmartPointer<vtkUnstructuredGrid> cut() {
    for (vtkIdType c = 0; c < from_.GetNumberOfCells(); c++) has_middle(from_, c) ? cut(c) : keep(c);
    return to_;
  }

 private:
  void keep(vtkIdType cell) {
    vtkIdType size = 0;
    const vtkIdType *ids = nullptr;
    from_.GetCells()->GetCellAtId(cell, size, ids);
    const int type = from_.GetCellType(cell);
    if (type != VTK_POLYHEDRON) add(cell, type, ids, size);  // else it is a ghost
  }

  void cut(vtkIdType cell) {
    get_faces(from_, cell, faces_);
    triangles_.clear();
    std::vector<vtkIdType> points;
    for (const auto &face : faces_) {
      cut_face(face);
      points.insert(points.end(), face.begin(), face.end());
    }
    leave_out_folded();
    const vtkIdType middle = add_middle(points);
    for (const Triangle &t : triangles_) {
      const vtkIdType tet[] = {middle, t[0], t[1], t[2]};
      add(cell, VTK_TETRA, tet, 4);
    }
  }

  void add(vtkIdType cell, int type, const vtkIdType *ids, vtkIdType size) {
    to_->GetCellData()->CopyData(from_.GetCellData(), cell, to_->InsertNextCell(type, size, ids));
  }

  // A quad from its lowest point on, as those of cells without a middle; a larger one around a middle of its own, as
  // points may lie between those of a neighbour in it.
  void cut_face(const std::vector<vtkIdType> &face) {
    const std::size_t n = face.size();
    if (n < 3) return;
    const vtkIdType middle = n > 4 ? middle_of_face(face) : -1;
    const auto lower = [&](vtkIdType a, vtkIdType b) { return places_.rank(a) < places_.rank(b); };
    const auto first = std::size_t(std::min_element(face.begin(), face.end(), lower) - face.begin());
    const auto at = [&](std::size_t k) { return face[(first + k) % n]; };
    if (middle >= 0)
      for (std::size_t k = 0; k < n; k++) triangles_.push_back({middle, at(k), at(k + 1)});
    else
      for (std::size_t k = 2; k < n; k++) triangles_.push_back({at(0), at(k - 1), at(k)});
  }

  // The same for both cells that have it.
  vtkIdType middle_of_face(const std::vector<vtkIdType> &face) {
    std::vector<vtkIdType> ranks = face;
    for (vtkIdType &id : ranks) id = places_.rank(id);
    std::sort(ranks.begin(), ranks.end());
    const auto [found, is_new] = middles_.emplace(std::move(ranks), -1);
    if (is_new) found->second = add_middle(face);
    return found->second;
  }

  vtkIdType add_middle(std::vector<vtkIdType> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    double p[3];
    for (int i = 0; i < 3; i++) p[i] = mean(*from_.GetPoints()->GetData(), points, i);
    const vtkIdType middle = to_->GetPoints()->InsertNextPoint(p);
    vtkPointData &data = *to_->GetPointData();
    for (int i = 0; i < data.GetNumberOfArrays(); i++) {
      vtkAbstractArray &array = *data.GetAbstractArray(i);
      array.InsertNextTuple(points[0], &array);  // of what has no means
      if (vtkDataArray *const numbers = data.GetArray(i); numbers != nullptr)
        for (int k = 0; k < numbers->GetNumberOfComponents(); k++)
          numbers->SetComponent(middle, k, mean(*numbers, points, k));
    }
    return middle;
  }

  // Between the least and the largest of the values, which the sum may pass by rounding: what is constant stays so.
  static double mean(vtkDataArray &array, const std::vector<vtkIdType> &points, int component) {
    double sum = 0, least = std::numeric_limits<double>::infinity(), most = -least;
    for (const vtkIdType id : points) {
      const double value = array.GetComponent(id, component);
      sum += value / static_cast<double>(points.size());  // a part: the whole may be more than a double holds
      least = std::min(least, value);
      most = std::max(most, value);
    }
    return std::min(std::max(sum, least), most);
  }

  // Two quads of a cell that have a point between the same two others may both have the triangle of these: it is there
  // twice, and bounds nothing.
  void leave_out_folded() {
    std::sort(triangles_.begin(), triangles_.end(),
              [&](const Triangle &a, const Triangle &b) { return ranks(a) < ranks(b); });
    auto kept = triangles_.begin();
    for (auto at = triangles_.begin(); at != triangles_.end();) {
      const bool is_there_twice = at + 1 != triangles_.end() && ranks(*at) == ranks(at[1]);
      if (!is_there_twice) *kept++ = *at;
      at += is_there_twice ? 2 : 1;
    }
    triangles_.erase(kept, triangles_.end());
  }

  Triangle ranks(Triangle t) const {
    for (vtkIdType &id : t) id = id < from_.GetNumberOfPoints() ? places_.rank(id) : id;
    std::sort(t.begin(), t.end());
    return t;
  }

  vtkUnstructuredGrid &from_;
  const Places places_;
  const vtkSmartPointer<vtkUnstructuredGrid> to_ = vtkSmartPointer<vtkUnstructuredGrid>::New();
  std::map<std::vector<vtkIdType>, vtkIdType> middles_;  // of faces, by their points
  Faces faces_;
  std::vector<Triangle> triangles_;  // of the cell
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> cut_around_middles(vtkUnstructuredGrid *grid, std::vector<std::string> &notes) {
  const vtkIdType middles = count_middles(*grid);
  if (middles == 0) return grid;
  notes.push_back(std::to_string(middles) + " polyhedra and prisms are cut around their middles, which are points " +
                  std::to_string(grid->GetNumberOfPoints()) + " and on");
  return Cutting(*grid).cut();
}

}  // namespace tetlod_vtk
