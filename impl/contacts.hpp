// Solids in contact: they lie on one another without sharing triangles, as the parts of an assembly do, or as one that
// is bent back to itself does.
#pragma once
#include <optional>

#include "job.hpp"
#include "kd_tree.hpp"
#include "mesh.hpp"
#include "surface_topology.hpp"

namespace tetlod {

class TreeOnDemand;

/// Pairs of components of a surface, or of one with itself.
class Contacts {
 public:
  explicit Contacts(Memory &memory) : pairs_(&memory), members_(&memory), itself_(memory) {}
  /// Pairs as pair_of() has them, in any order; itself: the places where one meets itself.
  Contacts(Array<std::uint64_t> pairs, KdTree &&itself);

  static std::uint64_t pair_of(std::int32_t a, std::int32_t b);

  bool empty() const { return pairs_.empty(); }
  bool between(std::int32_t a, std::int32_t b) const;
  /// Of this one with any.
  bool any(std::int32_t component) const;
  /// Whether a component meets itself there.
  bool itself_in(const Box &box) const {
    return itself_.any_overlap(box, [](std::int32_t) { return true; });
  }

 private:
  Array<std::uint64_t> pairs_;   // ascending
  Array<std::int32_t> members_;  // ascending
  KdTree itself_;
};

/// Those whose triangles meet, but nowhere reach into each other by more than a thousandth of the diagonal, along the
/// axis along which they do so least; and where they meet, there is material once, of one solid, behind each. None
/// where any other two overlap. with_itself: so are those of one component.
Contacts find_contacts(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree, bool with_itself,
                       Job &job);

/// Which triangles of a surface, or vertices, may meet: of components in contact, and, if it is one, where it meets
/// itself in the original.
struct MayMeet {
  const Contacts *contacts = nullptr;       ///< null: none
  Span<const std::int32_t> component = {};  ///< of each, as the contacts count them; -1: not known
  /// Triangles in these boxes.
  bool operator()(std::int32_t a, std::int32_t b, const Box &box_of_a, const Box &box_of_b) const {
    if (!contacts) return false;
    const std::int32_t one = component[std::size_t(a)], other = component[std::size_t(b)];
    return contacts->between(one, other) && (one != other || contacts->itself_in(common(box_of_a, box_of_b)));
  }
  bool any(std::int32_t a) const { return contacts && contacts->any(component[std::size_t(a)]); }
};

/// Of so many vertices of the original, whose boundary the surface is; -1: inside, or of several.
Array<std::int32_t> components_of_vertices(const Surface &surface, const SurfaceTopology &topology,
                                           std::size_t vertices, Memory &memory);

/// Of each triangle of what has become of it, whose points are these vertices or have come from them (came_from.hpp),
/// by a corner that is of one; -1: none is, or the triangle is none, with corners -1.
Array<std::int32_t> components_of_triangles(Span<const Triangle> triangles, Span<const std::int32_t> origin,
                                            Span<const std::int32_t> of_vertices, Memory &memory);

/// The same of a whole surface: of each of its components, the original's that has most of the vertices. vertex: of
/// each of its points, the original's that it is or has come from.
Array<std::int32_t> original_components(Span<const Triangle> triangles, const SurfaceTopology &topology,
                                        Span<const std::int32_t> vertex, const Surface &original,
                                        const SurfaceTopology &topology_of_original, Memory &memory);

/// Of a surface, looked for when they are first asked for.
class ContactsOnDemand {
 public:
  ContactsOnDemand() = default;
  explicit ContactsOnDemand(bool with_itself) : with_itself_(with_itself) {}

  const Contacts &get(const Surface &surface, const SurfaceTopology &topology, TreeOnDemand &tree, Job &job) {
    if (!contacts_) contacts_ = find_contacts(surface, topology, tree, with_itself_, job);
    return *contacts_;
  }

 private:
  bool with_itself_ = true;
  std::optional<Contacts> contacts_;
};

}  // namespace tetlod
