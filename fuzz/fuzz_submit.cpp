// What is taken in and handed out, in every type and layout, and every array that makes no sense. No run of the worker
// but the first: many inputs a second.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <limits>
#include <memory>

#include "demand.hpp"
#include "session.hpp"

namespace fuzz {

namespace {

enum class Kind { reals, integers, bytes, numbers };
constexpr std::int32_t any_components = 0;  // 1 to 64, as many as the caller likes
__extension__ using Wide = __int128;        // numbers that cannot overflow

// ---- Arrays that make no sense -------------------------------------------------------------------------------------

/// A description with one member changed, or with none.
tetlod_array tamper(tetlod_array array, Bytes &in) {
  const auto wild = [&] { return in.one_in(2) ? in.raw<std::int64_t>() : std::int64_t(in.raw<std::int8_t>()); };
  switch (in.below(16)) {
    case 0: array.struct_size = in.byte(); break;
    case 1: array.type = std::int32_t(in.between(-1, 7)); break;
    case 2: array.tuples = wild(); break;
    case 3: array.components = std::int32_t(in.between(-1, 9)); break;
    case 4: array.reserved = in.raw<std::int32_t>(); break;
    case 5: array.tuple_stride = wild(); break;
    case 6: array.component_stride = wild(); break;
    case 7: array.data = nullptr; break;
    case 8: array.data = static_cast<char *>(array.data) + in.below(9); break;
    case 9: array.tuple_stride = std::numeric_limits<std::int64_t>::min(); break;
    case 10: array.data = reinterpret_cast<void *>(in.raw<std::uintptr_t>()); break;
    default: break;
  }
  return array;
}

/// What is wrong with a description: any of these statuses is right.
class Wrongs {
 public:
  Wrongs(const tetlod_array &array, Kind kind, std::int32_t components) : array_(array) {
    add(array.struct_size < sizeof array, TETLOD_ERR_STRUCT_SIZE);
    add(array.reserved != 0 || array.tuples < 0 || !is_number(array.components, components), TETLOD_ERR_ARGUMENT);
    add(!is_of(kind), TETLOD_ERR_ARGUMENT);
    if (is_wrong()) return;
    add(array.tuples > 0 && !array.data, TETLOD_ERR_ARGUMENT);
    for (const std::int64_t part : {std::int64_t(array.tuples > 0 ? reinterpret_cast<std::uintptr_t>(array.data) : 0),
                                    array.tuple_stride, array.component_stride})
      add(part % element() != 0, TETLOD_ERR_ARGUMENT);
    add(leaves_memory(), TETLOD_ERR_ARGUMENT);
  }

  void add(bool holds, tetlod_status status) {
    if (holds) statuses_.push_back(status);
  }
  bool is_wrong() const { return !statuses_.empty(); }
  bool explain(tetlod_status status) const {
    return statuses_.empty() ? status == TETLOD_OK
                             : std::find(statuses_.begin(), statuses_.end(), status) != statuses_.end();
  }
  /// As the library understands it.
  Layout layout() const {
    Layout layout{array_.type, array_.tuples, array_.components, array_.tuple_stride, array_.component_stride};
    if (!layout.component_stride) layout.component_stride = element();
    if (!layout.tuple_stride) layout.tuple_stride = array_.components * element();
    return layout;
  }

 private:
  static bool is_number(std::int32_t is, std::int32_t wanted) {
    return wanted == any_components ? is >= 1 && is <= 64 : is == wanted;
  }
  bool is_of(Kind kind) const {
    if (kind == Kind::bytes) return array_.type == TETLOD_UINT8;
    if (kind == Kind::numbers) return array_.type >= TETLOD_INT32 && array_.type <= TETLOD_UINT8;
    if (kind == Kind::integers) return array_.type == TETLOD_INT32 || array_.type == TETLOD_INT64;
    return array_.type == TETLOD_FLOAT32 || array_.type == TETLOD_FLOAT64;
  }
  std::int64_t element() const { return Layout{array_.type, 0, 1, 0, 0}.element(); }

  bool leaves_memory() const {
    if (array_.tuples <= 0) return false;
    const Layout all = layout();
    const Wide start = Wide(reinterpret_cast<std::uintptr_t>(array_.data));
    const Wide far = Wide(all.tuples - 1) * all.tuple_stride, wide = Wide(all.components - 1) * all.component_stride;
    const Wide zero = 0, low = start + std::min(far, zero) + std::min(wide, zero);
    const Wide high = start + std::max(far, zero) + std::max(wide, zero) + all.element();
    const Wide most = std::numeric_limits<std::int64_t>::max();  // of a reach, as strides are such numbers
    return low < 0 || high > Wide(std::numeric_limits<std::uintptr_t>::max()) || high - start > most ||
           start - low > most;
  }

  const tetlod_array &array_;
  std::vector<tetlod_status> statuses_;
};

/// A description at an address that may be wrong; null at times.
template <class Call>
void submit_tampered(const Block &block, Kind kind, std::int32_t components, Bytes &in, const Call &call) {
  constexpr std::int64_t most = (std::int64_t(1) << 29) - 1;
  const tetlod_array array = tamper(block.array(), in), before = array;
  Wrongs wrongs(array, kind, components);
  wrongs.add(array.tuples > most, TETLOD_ERR_MESH_TOO_LARGE);
  const tetlod_status status = call(&array);
  DEMAND(std::memcmp(&array, &before, sizeof array) == 0, "a description is not written to");
  DEMAND(wrongs.explain(status), "an array of type %d, %ld x %d, strides %ld, %ld at %p: %d", array.type,
         long(array.tuples), array.components, long(array.tuple_stride), long(array.component_stride), array.data,
         status);
}

// ---- Submitting ----------------------------------------------------------------------------------------------------

void submit_nonsense(Session &session, Bytes &in) {
  const std::int64_t tuples = in.between(0, 6);
  tetlod_context *const c = session.context();
  const Block points(decode_layout(in.one_in(2) ? TETLOD_FLOAT32 : TETLOD_FLOAT64, tuples, 3, in));
  const Block tets(decode_layout(in.one_in(2) ? TETLOD_INT32 : TETLOD_INT64, tuples, 4, in));
  const Block values(decode_layout(in.one_in(2) ? TETLOD_FLOAT32 : TETLOD_FLOAT64, tuples, 1, in));
  submit_tampered(points, Kind::reals, 3, in, [c](const tetlod_array *a) { return tetlod_submit_points(c, a); });
  submit_tampered(tets, Kind::integers, 4, in, [c](const tetlod_array *a) { return tetlod_submit_tets(c, a, 1); });
  submit_tampered(values, Kind::reals, 1, in, [c](const tetlod_array *a) { return tetlod_submit_scalars(c, "x", a); });
  submit_tampered(tets, Kind::bytes, 1, in, [c](const tetlod_array *a) { return tetlod_submit_point_flags(c, a); });
  submit_tampered(points, Kind::numbers, any_components, in,
                  [c](const tetlod_array *a) { return tetlod_submit_field(c, "f", TETLOD_CELL_FIELD, a); });
  const Block flags(decode_layout(TETLOD_UINT8, tuples, 1, in));
  submit_tampered(flags, Kind::bytes, 1, in, [c](const tetlod_array *a) { return tetlod_submit_point_flags(c, a); });
  const tetlod_array good = values.array();
  submit_tampered(values, Kind::reals, 1, in, [&](const tetlod_array *a) {
    const tetlod_status status = tetlod_submit_points_xyz(c, &good, a, &good);
    const bool shorter = status == TETLOD_ERR_ARGUMENT && a->tuples != good.tuples;
    return shorter ? (Wrongs(*a, Kind::reals, 1).is_wrong() ? status : TETLOD_OK) : status;
  });
  const auto base = std::int32_t(in.between(-2, 3));
  const tetlod_array corners = tets.array();
  const tetlod_status status = tetlod_submit_tets(c, &corners, base);
  DEMAND(status == (base == 0 || base == 1 ? TETLOD_OK : TETLOD_ERR_ARGUMENT), "base %d: %d", base, status);
  submit_tampered(values, Kind::reals, 1, in,
                  [c](const tetlod_array *a) { return tetlod_submit_steering(c, "g", 1, a); });
  session.clear();  // the blocks go
}

/// The three columns of the points in arrays of their own.
void submit_columns(Session &session, const Mesh &mesh, Bytes &in, std::vector<std::unique_ptr<Block>> &columns) {
  tetlod_array arrays[3];
  for (std::size_t k = 0; k < 3; k++) {
    columns.push_back(std::make_unique<Block>(decode_layout(TETLOD_FLOAT64, mesh.point_count(), 1, in)));
    for (std::int64_t i = 0; i < mesh.point_count(); i++) columns.back()->set(i, 0, mesh.points[std::size_t(i)][k]);
    arrays[k] = columns.back()->array();
  }
  const tetlod_status status = tetlod_submit_points_xyz(session.context(), &arrays[0], &arrays[1], &arrays[2]);
  DEMAND(status == TETLOD_OK, "three columns are taken: %d", status);
}

std::vector<unsigned char> checked_bytes(const Session &session, tetlod_status &status, std::uint64_t &estimate) {
  tetlod_mesh_report report;
  std::memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  status = tetlod_check(session.context(), &report);
  tetlod_estimate_memory(session.context(), &estimate);
  const auto *const bytes = reinterpret_cast<const unsigned char *>(&report);
  return std::vector<unsigned char>(bytes, bytes + sizeof report);
}

/// What is found in a mesh does not depend on how it lies in memory; and only what is an element is read.
void check_in_layouts(Session &session, Bytes &in) {
  const Mesh mesh = decode_mesh(in);
  session.submit_points(mesh, in);
  session.submit_tets(mesh, in);
  session.submit_values(mesh, in);
  const Mesh rounded = session.mesh();
  tetlod_status strided_status, packed_status;
  std::uint64_t strided_estimate = 0, packed_estimate = 0;
  const std::int64_t base = session.base();
  const auto strided = checked_bytes(session, strided_status, strided_estimate);
  session.submit_plain(rounded, std::int32_t(base));
  std::vector<std::unique_ptr<Block>> columns;
  if (in.one_in(2)) submit_columns(session, rounded, in, columns);
  const auto packed = checked_bytes(session, packed_status, packed_estimate);
  DEMAND(strided_status == packed_status, "tetlod_check: %d strided, %d packed", strided_status, packed_status);
  DEMAND(strided == packed, "tetlod_check finds the same in every layout");
  session.clear();
}

// ---- Handing out ---------------------------------------------------------------------------------------------------

/// A context that has run once.
Session &finished() {
  static Session *const session = [] {
    auto *const made = new Session({});  // until the process ends: the result is fetched from it all the time
    Mesh mesh = grid_mesh(known_cells(2));
    for (const Point &p : mesh.points) mesh.values.push_back(p[0] + p[1] * p[2]);
    made->submit_all(mesh);
    static const std::vector<double> halves(3 * mesh.points.size(), 0.5);
    const tetlod_array field = {
        sizeof field, TETLOD_FLOAT64, mesh.point_count(), 3, 0, 0, 0, const_cast<double *>(halves.data())};
    DEMAND(tetlod_submit_field(made->context(), "halves", TETLOD_POINT_FIELD, &field) == TETLOD_OK, "a field is taken");
    DEMAND(made->run({}) == TETLOD_OK, "a cube can be simplified");
    return made;
  }();
  return *session;
}

/// c component strides as long as some tuple strides: two elements in one place.
bool overlaps(const Layout &layout) {
  for (std::int64_t c = 1; c < layout.components; c++) {
    const Wide way = Wide(c) * layout.component_stride, tuples = way / layout.tuple_stride;
    if (tuples * layout.tuple_stride == way && tuples < layout.tuples && -tuples < layout.tuples) return true;
  }
  return false;
}

/// get is what is to be in the array.
template <class Call, class Get>
void fetch(Bytes &in, Kind kind, std::int64_t tuples, std::int32_t components, const Call &call, const Get &get) {
  const std::int32_t type = kind == Kind::reals ? (in.one_in(2) ? TETLOD_FLOAT32 : TETLOD_FLOAT64)
                                                : (in.one_in(2) ? TETLOD_INT32 : TETLOD_INT64);
  const std::int64_t room = std::max<std::int64_t>(0, tuples + in.between(-2, 5));
  Block block(decode_layout(type, room, components, in));
  const bool tampers = in.one_in(2);
  const tetlod_array sound = block.array();
  tetlod_array array = tampers ? tamper(sound, in) : sound;
  Wrongs wrongs(array, kind, components);
  wrongs.add(array.tuples < tuples, TETLOD_ERR_BUFFER_SIZE);
  if (!wrongs.is_wrong()) wrongs.add(overlaps(wrongs.layout()), TETLOD_ERR_ARGUMENT);
  const bool elsewhere = std::memcmp(&array, &sound, sizeof array) != 0;
  if (!wrongs.is_wrong() && elsewhere) return;  // in memory that is not there
  const tetlod_status status = call(&array);
  DEMAND(wrongs.explain(status), "fetching into type %d, %ld x %d, strides %ld, %ld: %d", array.type,
         long(array.tuples), array.components, long(array.tuple_stride), long(array.component_stride), status);
  DEMAND(block.rest_untouched(status == TETLOD_OK ? tuples : 0), "only the elements of the result are written");
  for (std::int64_t i = 0; i < tuples && status == TETLOD_OK; i++)
    for (std::int32_t c = 0; c < components; c++) DEMAND(get(block, i, c), "element %ld %d is fetched", long(i), c);
}

bool is_rounded(const Block &block, std::int64_t i, std::int32_t c, double value) {
  return block.real(i, c) == (block.layout().type == TETLOD_FLOAT64 ? value : double(float(value)));
}

/// One of the two arrays is in order.
void fetch_stencil(Bytes &in, std::int64_t points) {
  const tetlod_context *const c = finished().context();
  const Block other(packed(in.one_in(2) ? TETLOD_FLOAT64 : TETLOD_INT32, points, 4));
  tetlod_array sound = other.array();
  const auto at_least = [](const Block &b, std::int64_t i, std::int32_t k) { return b.real(i, k) >= 0; };
  if (sound.type == TETLOD_INT32)
    return fetch(
        in, Kind::reals, points, 4, [&](tetlod_array *a) { return tetlod_fetch_stencil(c, 0, &sound, a); }, at_least);
  return fetch(
      in, Kind::integers, points, 4, [&](tetlod_array *a) { return tetlod_fetch_stencil(c, 1, a, &sound); },
      [](const Block &b, std::int64_t i, std::int32_t k) { return b.integer(i, k) >= 1; });
}

void fetch_something(Bytes &in) {
  const Session &session = finished();
  const tetlod_context *const c = session.context();
  const Fetched &last = session.last();
  const auto base = std::int32_t(in.below(2));
  switch (in.below(6)) {
    case 0:
      return fetch(
          in, Kind::reals, std::int64_t(last.points.size()), 3,
          [&](tetlod_array *a) { return tetlod_fetch_points(c, a); },
          [&](const Block &b, std::int64_t i, std::int32_t k) {
            return is_rounded(b, i, k, last.points[std::size_t(i)][std::size_t(k)]);
          });
    case 1:
      return fetch(
          in, Kind::integers, std::int64_t(last.tets.size()), 4,
          [&](tetlod_array *a) { return tetlod_fetch_tets(c, base, a); },
          [&](const Block &b, std::int64_t i, std::int32_t k) {
            return b.integer(i, k) == last.tets[std::size_t(i)][std::size_t(k)] + base;
          });
    case 2:
      return fetch(
          in, Kind::integers, std::int64_t(last.boundary.size()), 3,
          [&](tetlod_array *a) { return tetlod_fetch_boundary(c, base, a); },
          [&](const Block &b, std::int64_t i, std::int32_t k) {
            return b.integer(i, k) == last.boundary[std::size_t(i)][std::size_t(k)] + base;
          });
    case 3:
      return fetch(
          in, Kind::reals, std::int64_t(last.points.size()), 3,
          [&](tetlod_array *a) { return tetlod_fetch_field(c, "halves", a); },
          [](const Block &b, std::int64_t i, std::int32_t k) { return b.real(i, k) == 0.5; });
    case 4: return fetch_stencil(in, std::int64_t(last.points.size()));
    default:
      return fetch(
          in, Kind::reals, std::int64_t(last.values.size()), 1,
          [&](tetlod_array *a) { return tetlod_fetch_scalars(c, a); },
          [&](const Block &b, std::int64_t i, std::int32_t k) {
            return is_rounded(b, i, k, last.values[std::size_t(i)]);
          });
  }
}

/// Structs of callers that are older, down to `least` bytes, or newer.
template <class Struct>
void fill_struct_of_any_size(const char *what, std::size_t least, Bytes &in,
                             tetlod_status (*call)(const tetlod_context *, Struct *)) {
  const auto size = std::uint32_t(in.below(2 * sizeof(Struct)));
  alignas(Struct) unsigned char memory[2 * sizeof(Struct)];
  std::memset(memory, 0xa7, sizeof memory);
  std::memcpy(memory, &size, sizeof size);
  const tetlod_status status = call(finished().context(), reinterpret_cast<Struct *>(memory));
  DEMAND(status == (size < least ? TETLOD_ERR_STRUCT_SIZE : TETLOD_OK), "%s of %u bytes: %d", what, size, status);
  const std::size_t written = status == TETLOD_OK ? std::min<std::size_t>(size, sizeof(Struct)) : sizeof size;
  for (std::size_t i = written; i < sizeof memory; i++)
    DEMAND(memory[i] == 0xa7, "%s: byte %zu is not theirs", what, i);
  DEMAND(std::memcmp(memory, &size, sizeof size) == 0, "%s: struct_size stays", what);
}

void fetch_structs(Bytes &in) {
  fill_struct_of_any_size<tetlod_run_report>("the report", offsetof(tetlod_run_report, scalar_max) + sizeof(double), in,
                                             tetlod_fetch_report);
  fill_struct_of_any_size<tetlod_array>("a view", sizeof(tetlod_array), in, tetlod_view_tets);
  fill_struct_of_any_size<tetlod_array>("a view", sizeof(tetlod_array), in, tetlod_view_points);
  fill_struct_of_any_size<tetlod_array>("a view", sizeof(tetlod_array), in, tetlod_view_scalars);
}

void run(Bytes &in) {
  Session session({});
  for (int i = 0; i < 4 && (i == 0 || !in.empty()); i++) {
    switch (in.below(4)) {
      case 0: submit_nonsense(session, in); break;
      case 1: check_in_layouts(session, in); break;
      case 2: fetch_something(in); break;
      default: fetch_structs(in);
    }
  }
}

}  // namespace

}  // namespace fuzz

extern "C" int LLVMFuzzerInitialize(int *, char ***) {
  fuzz::settle();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzz::finished();
  fuzz::Bytes in(data, size);
  fuzz::run(in);
  return 0;
}
