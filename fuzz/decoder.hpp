// From the fuzzer's bytes to what a host may hand to the library: a mesh with edits, options, a surface with samples.
#pragma once
#include <cstdint>
#include <vector>

#include "bytes.hpp"
#include "meshes.hpp"

namespace fuzz {

/// At most some 200 tets: many inputs a second matter more than large ones.
Mesh decode_mesh(Bytes &in);

/// An option by its number, for whatever options there are: the number may be that of none, the value out of bounds.
struct Setting {
  std::int32_t option = 0;
  double real = 0;
  std::int64_t integer = 0;
};

/// least, most and preset are what the library says of the option.
struct Bounds {
  bool integer = false;
  double least = 0, most = 0, preset = 0;
};
std::int32_t decode_option(Bytes &in);
Setting decode_value(std::int32_t option, const Bounds &bounds, Bytes &in);

}  // namespace fuzz
