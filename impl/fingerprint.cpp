#include "fingerprint.hpp"

#include "whole_arrays.hpp"

namespace tetlod {

void Fingerprint::add(const StridedArray &array, Job &job) {
  for (const std::int64_t shape : {std::int64_t(array.present), std::int64_t(array.type), array.tuples,
                                   std::int64_t(array.components), array.tuple_stride, array.component_stride})
    add(std::uint64_t(shape));
  if (!array.present) return;
  if (array.packed_as(array.type)) {
    const std::size_t tuple = std::size_t(array.components) * element_size(array.type);
    return add_bytes(array.data, std::size_t(array.tuples) * tuple, job);
  }
  switch (element_size(array.type)) {
    case 8: return add_elements<std::uint64_t>(array, job);
    case 4: return add_elements<std::uint32_t>(array, job);
    default: return add_elements<std::uint8_t>(array, job);
  }
}

template <class Word>
void Fingerprint::add_elements(const StridedArray &array, Job &job) {
  add_parts(std::size_t(array.tuples), job, [&](Fingerprint &part, std::size_t i) {
    for (int c = 0; c < array.components; c++) {
      Word word;
      std::memcpy(&word, array.data + std::int64_t(i) * array.tuple_stride + c * array.component_stride, sizeof word);
      part.add(std::uint64_t(word));
    }
  });
}

void Fingerprint::add_bytes(const unsigned char *bytes, std::size_t count, Job &job) {
  add_parts(count / 8, job, [&](Fingerprint &part, std::size_t i) {
    std::uint64_t word;
    std::memcpy(&word, bytes + 8 * i, 8);
    part.add(word);
  });
  if (count % 8 == 0) return;
  std::uint64_t rest = 0;
  std::memcpy(&rest, bytes + count / 8 * 8, count % 8);
  add(rest);
}

template <class Add>
void Fingerprint::add_parts(std::size_t count, Job &job, const Add &add_item) {
  for (const Fingerprint &part : parts_of(count, Fingerprint(), job, add_item))
    for (std::size_t half = 0; half < 2; half++) add(part.word(half));
}

}  // namespace tetlod
