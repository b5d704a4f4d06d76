// The C ABI as the benchmarks call it: contexts that end by themselves, and statuses that are exceptions.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "bench_mesh.hpp"
#include "tetlod.h"

namespace bench {

struct Destroy {
  void operator()(tetlod_context *context) const { tetlod_destroy(context); }
};
using Context = std::unique_ptr<tetlod_context, Destroy>;

// Throws std::runtime_error with the context's message; nullptr: the thread's own.
void check(tetlod_status status, const tetlod_context *context);

Context make_context();

// The library reads what it is lent and writes nothing there.
tetlod_array lent(std::int32_t type, std::size_t tuples, std::int32_t components, const void *data);

// What a tetlod_view_ function shows, until the context's next run; and a copy of it.
tetlod_array viewed(tetlod_status (*view)(const tetlod_context *, tetlod_array *), const tetlod_context *context);
template <class T>
std::vector<T> copied(const tetlod_array &array) {
  const T *const begin = static_cast<const T *>(array.data);
  return std::vector<T>(begin, begin + array.tuples);
}

// The mesh must stay.
void submit(tetlod_context *context, const Mesh &mesh);

}  // namespace bench
