#include "fingerprint.hpp"

#include <algorithm>

namespace tetlod {

namespace {

constexpr std::size_t block = 1 << 16;

}  // namespace

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
  for (std::int64_t i = 0; i < array.tuples; i++) {
    if (std::size_t(i) % block == 0) job.poll(0);
    for (int c = 0; c < array.components; c++) {
      Word word;
      std::memcpy(&word, array.data + i * array.tuple_stride + c * array.component_stride, sizeof word);
      add(std::uint64_t(word));
    }
  }
}

void Fingerprint::add_bytes(const unsigned char *bytes, std::size_t count, Job &job) {
  for (std::size_t i = 0; i < count; i += 8) {
    if (i % (8 * block) == 0) job.poll(0);
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min<std::size_t>(8, count - i));
    add(word);
  }
}

}  // namespace tetlod
