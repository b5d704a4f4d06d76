#include "middles.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include "lent_array.hpp"
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

// Flags and marks are no numbers that have means.
bool has_means(vtkDataArray &array, vtkPointData &data, vtkDataArray *flags) {
  return &array != flags && &array != data.GetGlobalIds() &&
         &array != data.GetArray(vtkDataSetAttributes::GhostArrayName());
}

// Integers become doubles, as they do on a result: means are none.
vtkSmartPointer<vtkAbstractArray> copy_of(vtkAbstractArray &array, bool becomes_double) {
  const auto copy = becomes_double ? vtkSmartPointer<vtkAbstractArray>(vtkSmartPointer<vtkDoubleArray>::New())
                                   : vtk::TakeSmartPointer(array.NewInstance());
  copy->DeepCopy(&array);
  copy->SetName(array.GetName());
  return copy;
}

class Cutting {
 public:
  Cutting(vtkUnstructuredGrid &from, const std::string &flags) : from_(from), places_(from) {
    copy_points();
    copy_point_data(flags);
    to_->GetCellData()->CopyAllOn();
    to_->GetCellData()->CopyAllocate(from.GetCellData(), from.GetNumberOfCells());
    to_->Allocate(from.GetNumberOfCells());
  }

  vtkSmartPointer<vtkUnstructuredGrid> cut() {
    for (vtkIdType c = 0; c < from_.GetNumberOfCells(); c++) has_middle(from_, c) ? cut(c) : keep(c);
    return to_;
  }

 private:
  void copy_points() {
    vtkNew<vtkPoints> points;
    points->SetDataType(from_.GetPoints()->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
    points->SetNumberOfPoints(from_.GetNumberOfPoints());
    for (vtkIdType v = 0; v < from_.GetNumberOfPoints(); v++) points->SetPoint(v, from_.GetPoint(v));
    to_->SetPoints(points);
  }

  void copy_point_data(const std::string &flags) {
    vtkPointData &from = *from_.GetPointData(), &to = *to_->GetPointData();
    vtkDataArray *const of_flags = flags.empty() ? nullptr : from.GetArray(flags.c_str());
    for (int i = 0; i < from.GetNumberOfArrays(); i++) {
      vtkDataArray *const numbers = from.GetArray(i);
      has_means_.push_back(numbers != nullptr && has_means(*numbers, from, of_flags));
      to.AddArray(copy_of(*from.GetAbstractArray(i), has_means_.back() && !is_real(numbers->GetDataType())));
    }
    int active[vtkDataSetAttributes::NUM_ATTRIBUTES];
    from.GetAttributeIndices(active);
    for (int kind = 0; kind < vtkDataSetAttributes::NUM_ATTRIBUTES; kind++)
      if (active[kind] >= 0) to.SetActiveAttribute(active[kind], kind);
    if (of_flags != nullptr) flags_ = to.GetArray(flags.c_str());
  }

  void keep(vtkIdType cell) {
    const int type = from_.GetCellType(cell);
    vtkIdType size = 0;
    const vtkIdType *ids = nullptr;
    from_.GetCells()->GetCellAtId(cell, size, ids);
    if (is_solid(type)) points_of(from_, cell, 0);           // which names the cell, as long as it has its number
    if (type != VTK_POLYHEDRON) add(cell, type, ids, size);  // else it is a ghost
  }

  void cut(vtkIdType cell) {
    get_faces(from_, cell, faces_);
    triangles_.clear();
    std::vector<vtkIdType> points;
    for (auto &face : faces_) {
      leave_out_repeated(face);
      cut_face(face);
      points.insert(points.end(), face.begin(), face.end());
    }
    leave_out_folded();
    if (triangles_.empty()) return;
    const vtkIdType middle = add_middle(points, 0);
    for (const Triangle &t : triangles_) {
      vtkIdType tet[] = {middle, t[0], t[1], t[2]};
      orient(*to_, tet);
      add(cell, VTK_TETRA, tet, 4);
    }
  }

  void add(vtkIdType cell, int type, const vtkIdType *ids, vtkIdType size) {
    to_->GetCellData()->CopyData(from_.GetCellData(), cell, to_->InsertNextCell(type, size, ids));
  }

  // Those that are at one place with the one before.
  void leave_out_repeated(std::vector<vtkIdType> &face) const {
    const auto same = [&](vtkIdType a, vtkIdType b) { return places_.rank(a) == places_.rank(b); };
    face.erase(std::unique(face.begin(), face.end(), same), face.end());
    while (face.size() > 1 && same(face.front(), face.back())) face.pop_back();
  }

  // A quad from its lowest point on, as those of cells without a middle; a larger one around a middle of its own, as
  // points may lie between those of a neighbour in it.
  void cut_face(std::vector<vtkIdType> &face) {
    const std::size_t n = face.size();
    if (n > 4) {
      const vtkIdType middle = middle_of_face(face);
      for (std::size_t k = 0; k < n; k++) triangles_.push_back({middle, face[k], face[(k + 1) % n]});
    } else if (n > 2) {
      places_.begin_at_lowest(face);
      for (std::size_t k = 2; k < n; k++) triangles_.push_back({face[0], face[k - 1], face[k]});
    }
  }

  // The same for both cells that have it. Cells with points of their own where they meet have middles of their own
  // there, at exactly one place, too. It is flagged as all of the face's points are.
  vtkIdType middle_of_face(std::vector<vtkIdType> face) {
    std::sort(face.begin(), face.end());
    const auto [found, is_new] = middles_.emplace(face, -1);
    if (!is_new) return found->second;
    found->second = add_middle(face, flags_of_all(face));
    std::vector<vtkIdType> place = face;
    for (vtkIdType &id : place) id = places_.rank(id);
    std::sort(place.begin(), place.end());
    const vtkIdType first = first_middle_.emplace(std::move(place), found->second).first->second;
    to_->GetPoints()->SetPoint(found->second, point(*to_, first).data());
    return found->second;
  }

  int flags_of_all(const std::vector<vtkIdType> &points) const {
    if (flags_ == nullptr) return 0;
    int all = 255;
    for (const vtkIdType id : points) all &= int(flags_->GetComponent(id, 0));
    return all;
  }

  // In the mean of points.
  vtkIdType add_middle(std::vector<vtkIdType> points, int flags) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    double p[3];
    for (int i = 0; i < 3; i++) p[i] = mean(*from_.GetPoints()->GetData(), points, i);
    const vtkIdType middle = to_->GetPoints()->InsertNextPoint(p);
    vtkPointData &data = *to_->GetPointData();
    for (int i = 0; i < data.GetNumberOfArrays(); i++) {
      vtkAbstractArray &array = *data.GetAbstractArray(i);
      array.InsertNextTuple(points[0], &array);  // of what has no means
      if (vtkDataArray *const numbers = data.GetArray(i); has_means_[std::size_t(i)])
        for (int k = 0; k < numbers->GetNumberOfComponents(); k++)
          numbers->SetComponent(middle, k, mean(*numbers, points, k));
    }
    if (flags_ != nullptr) flags_->SetComponent(middle, 0, flags);
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
  vtkDataArray *flags_ = nullptr;  // of the copy's points; null: there are none
  const Places places_;
  const vtkSmartPointer<vtkUnstructuredGrid> to_ = vtkSmartPointer<vtkUnstructuredGrid>::New();
  std::vector<bool> has_means_;                                         // of each array of point data
  std::map<std::vector<vtkIdType>, vtkIdType> middles_, first_middle_;  // of faces, by their points; by their places
  Faces faces_;
  std::vector<Triangle> triangles_;  // of the cell
};

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> cut_around_middles(vtkUnstructuredGrid *grid, const std::string &flags,
                                                        std::vector<std::string> &notes) {
  const vtkIdType middles = count_middles(*grid);
  if (middles == 0) return grid;
  notes.push_back(std::to_string(middles) + " polyhedra and prisms are cut around their middles, which are points " +
                  std::to_string(grid->GetNumberOfPoints()) + " and on");
  return Cutting(*grid, flags).cut();
}

}  // namespace tetlod_vtk
