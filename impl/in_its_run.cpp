#include "in_its_run.hpp"

#include "prepare.hpp"
#include "status.hpp"

namespace tetlod {

namespace {

void refuse_changed(const Fingerprint &mesh, const Result &result) {
  if (!(mesh == result.original))
    fail(Status::state,
         "the submitted points or tets, or which values are finite, have changed since the run that made the result");
}

void refuse_other_jumps(const Original &original, const Result &result) {
  if (original.torn != result.torn || !(original.moves.opened == result.moves.opened))
    fail(Status::state, "a field jumps in other places of the mesh since the run that made the result");
}

}  // namespace

Prepared &as_in_its_run(const Input &input, const Options &options, const Result &result, Prepared &kept,
                        Prepared &fresh, Job &job) {
  const Fingerprint mesh = fingerprint_of_mesh(input, options, job);
  refuse_changed(mesh, result);
  const bool held = kept.holds(mesh, input, options, job) && kept.original.moves == result.moves;
  if (!held) {
    Input bare = input;
    bare.flags = {};  // which change nothing but moves, and may be wrong
    prepare_with_boundary(bare, options, job, fresh.original, fresh.boundary, &result.moves);
  }
  Prepared &prepared = held ? kept : fresh;
  refuse_other_jumps(prepared.original, result);
  return prepared;
}

}  // namespace tetlod
