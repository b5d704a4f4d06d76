// Values of fields of every type: what is submitted, and what may become of them.
#pragma once
#include <cmath>
#include <vector>

#include "layouts.hpp"
#include "session.hpp"

namespace fuzz {

std::int32_t any_integer(Bytes &in);  ///< a type of 32 or 64 bits
std::int32_t any_components(Bytes &in);

Layout any_layout(std::int32_t type, std::int64_t tuples, std::int32_t components, Bytes &in);
Layout any_reals(std::int64_t tuples, std::int32_t components, Bytes &in);
/// Of any type.
Layout any_numbers(std::int64_t tuples, std::int32_t components, Bytes &in);
/// Where such values go to, whatever they are; of integers rarely what does not take them.
Layout any_room_for(const Block &values, std::int64_t tuples, std::int32_t components, Bytes &in);

void fill_field(Block &block, Bytes &in);

bool is_integer(const Block &block);
/// TETLOD_INT64 or TETLOD_FLOAT64, which take all values of the block.
std::int32_t wide_type(const Block &block);

/// A real; an integer, as none is negative, by the double of the same bits, so that nothing is lost.
double value_of(const Block &block, std::int64_t tuple, std::int32_t component);
std::vector<double> values_of(const Block &block);

inline bool same_or_both_nan(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// What vertex i of a result may have of the original's values.
void check_moved(const Stencil &stencil, std::size_t i, std::int32_t component, double value, const Block &original);

}  // namespace fuzz
