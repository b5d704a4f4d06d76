// Asked of what is submitted, before a run: its defects, and what the run would need.
#include "arguments.hpp"
#include "context.hpp"
#include "prepare.hpp"
#include "validate.hpp"
#include "work.hpp"

namespace tetlod::capi {

namespace {

/// Where no scalars are submitted every point has the value 0.
Input with_scalars(const Input &input) {
  static constexpr double zero = 0;
  Input complete = input;
  if (complete.scalars.present) return complete;
  complete.scalars.type = ElementType::float64;
  complete.scalars.components = 1;
  complete.scalars.tuples = input.xyz[0].tuples;
  complete.scalars.data = reinterpret_cast<unsigned char *>(const_cast<double *>(&zero));  // only read
  return complete;
}

tetlod_defect defect_of(const Defect &defect) { return {defect.count, defect.first}; }

tetlod_mesh_report report_of(const Defects &defects, Status verdict) {
  tetlod_mesh_report to{};
  to.status = tetlod_status(verdict);
  to.points = defects.points;
  to.tets = defects.tets;
  to.boundary_triangles = defects.boundary_triangles;
  to.components = defects.components;
  to.index = defect_of(defects.index);
  to.repeated = defect_of(defects.repeated);
  to.nonfinite_points = defect_of(defects.nonfinite_points);
  to.nonfinite_values = defect_of(defects.nonfinite_values);
  to.coincident = defect_of(defects.coincident);
  to.flat = defect_of(defects.flat);
  to.inverted = defect_of(defects.inverted);
  to.duplicate = defect_of(defects.duplicate);
  to.nonmanifold_faces = defect_of(defects.nonmanifold_faces);
  to.overlapping = defect_of(defects.overlapping);
  to.unused = defect_of(defects.unused);
  to.nonmanifold_edges = defect_of(defects.nonmanifold_edges);
  to.nonmanifold_points = defect_of(defects.nonmanifold_points);
  return to;
}

}  // namespace

}  // namespace tetlod::capi

using namespace tetlod;
using namespace tetlod::capi;

tetlod_status tetlod_check(tetlod_context *handle, tetlod_mesh_report *out) {
  return entry(handle, [&](tetlod_context &context) {
    begin(context);
    require_struct(out, "out", TETLOD_SIZE_TO(tetlod_mesh_report, nonmanifold_points));
    require_mesh(context.input);
    Job job = job_of(context);
    const Input input = with_scalars(context.input);
    ahead_of_what_is_kept(context, [&] {
      const Defects defects = find_defects(input, context.options, job);
      const Error verdict = verdict_on(input, context.options, defects, job);
      copy_struct(report_of(defects, verdict.status()), out);
      if (verdict.status() != Status::ok) context.message.set(verdict.what());
    });
  });
}

tetlod_status tetlod_estimate_memory(tetlod_context *handle, uint64_t *bytes) {
  return entry(handle, [&](tetlod_context &context) {
    begin(context);
    require_pointer(bytes, "bytes");
    require_mesh(context.input);
    Job job = job_of(context);
    const Input input = with_scalars(context.input);
    check_counts(input);
    with_what_is_kept(context, [&] { *bytes = estimate_memory(input, context.options, context.prepared, job); });
  });
}
