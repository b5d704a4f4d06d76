// What runs of one mesh have in common, kept from each for the next. A rule for each part says what it depends on:
//   original, boundary, surface, topology   points, tets, flags, merge-tolerance, policies (the stamp), while all
//                                           values are finite, and whether contacts are taken and max-deviation,
//                                           if points of parts that touch, or of cracks, are at one place, and
//                                           where fields jump between these
//   the decimation                          that, lambda, clean-edges, max-deviation, and the field if its cost sees it
//   the history of collapses                the original, its values and how they count; for a warm start, others
//   verdicts                                the decimation and how far it went, min-distance, boundary-leaf
// What it depends on is compared by fingerprints, so that arrays may be changed in place, or submitted anew unchanged.
// Whatever is taken over has the bytes that a run without it would make, but for a warm start.
#pragma once
#include <cstdint>

#include "contacts.hpp"
#include "decimate_boundary.hpp"
#include "deviation.hpp"
#include "extract_boundary.hpp"
#include "fingerprint.hpp"
#include "pipeline.hpp"
#include "prepare.hpp"
#include "solid_state.hpp"
#include "surface_topology.hpp"

namespace tetlod {

/// Of its points and tets, and of where those are that a value without one removes.
Fingerprint fingerprint_of_mesh(const Input &input, const Options &options, Job &job);

class Prepared {
 public:
  explicit Prepared(Memory &memory)
      : original(memory),
        boundary(memory),
        surface_(memory),
        topology_(memory),
        solids_(&memory),
        careless_(memory),
        careful_(memory),
        history_(memory),
        verdicts_(&memory) {}

  Original original;
  Boundary boundary;

  /// True: original (with the input's values) and boundary are those of the input. False: both are empty, to be filled;
  /// then say complete(). mesh: fingerprint_of_mesh(input).
  bool renew(const Fingerprint &mesh, const Input &input, const Options &options, Job &job);
  /// The same, but if false, mesh and boundary stay what they are, but for values.
  bool holds(const Fingerprint &mesh, const Input &input, const Options &options, Job &job);
  void complete() { filled_ = true; }
  void forget(Memory &memory) { *this = Prepared(memory); }
  bool empty() const { return !filled_; }

  /// The boundary with its values, and how it hangs together.
  const Surface &surface(Job &job);
  const SurfaceTopology &topology(Job &job);
  /// Of the surface.
  ContactsOnDemand &contacts() { return contacts_; }
  /// Of each original vertex, as MeshView::solid.
  Span<const std::int32_t> solids(Job &job);

  struct Decimated {
    std::int64_t cleaned_edges = 0;
    bool reused = false;  ///< no cost was computed
  };
  /// surface(), decimated, which crosses itself nowhere. Throws Status::mesh_intersecting, with vertices numbered from
  /// index_base.
  Decimated decimate(const DecimateOptions &options, std::int32_t index_base, Job &job, Surface &out);

  /// Between surface(), whose tree it is, and what decimate() made of it last, at these samples of both.
  double deviation(TreeOnDemand &tree, const Surface &decimated, Samples samples, Job &job);

  /// Of the original while its edges collapsed that way, with the values that it has now, or, if that keeps them, with
  /// earlier ones.
  SolidHistory &history(const CollapseWay &way, Job &job);

  /// Of each original vertex, what culling with these found of it at the last decimated surface.
  Span<std::uint8_t> verdicts(double least_distance, std::int64_t leaf, Memory &memory);

 private:
  void prepare_surface(Job &job);
  void fill_surface(Job &job);
  DecimateReport decimate_logged(const DecimateOptions &options, Span<const std::uint8_t> flags, Job &job,
                                 Surface &surface, bool &reused);
  Array<std::uint8_t> flags_of_surface(Job &job) const;

  /// A decimation with its log; careful or not they are different ones.
  struct Logged {
    explicit Logged(Memory &memory) : log(memory) {}
    bool holds(const DecimateOptions &of, const Fingerprint &of_values) const;
    bool filled = false;
    CollapseLog log;
    DecimateOptions options;
    Fingerprint values;
  };

  /// Which decimated surface.
  struct Way {
    bool careful = false;
    std::int64_t collapses = -1;
    bool operator!=(const Way &other) const { return careful != other.careful || collapses != other.collapses; }
  };

  bool filled_ = false, has_surface_ = false;
  bool surface_has_values_ = false;  ///< the original's of now
  Fingerprint stamp_;
  bool took_contacts_ = false;
  double max_deviation_ = 0;
  Surface surface_;
  SurfaceTopology topology_;
  ContactsOnDemand contacts_;
  Array<std::int32_t> solids_;
  Logged careless_, careful_;
  SolidHistory history_;
  Way last_;
  Array<std::uint8_t> verdicts_;
  double verdicts_distance_ = 0;
  std::int64_t verdicts_leaf_ = 0;
  Way verdicts_way_;
  double deviation_ = 0;
  Way deviation_way_;
};

}  // namespace tetlod
