#include "scale.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cli {
namespace {

constexpr std::size_t kBins = 64;
constexpr double kManyTimes = 5;              // the least value
constexpr double kNextToZero = 1e-3;          // of the greatest value
constexpr double kHardlyAny = 2, kByFar = 1;  // bits

// Bits that the parts of a scale tell of a value: the more, the more evenly the values are spread over it.
double bits_of(const Scale &scale, const std::vector<double> &values) {
  std::vector<double> counts(kBins, 0);
  for (const double value : values) counts[std::min(std::size_t(scale.share(value) * kBins), kBins - 1)]++;
  double bits = 0;
  for (const double count : counts) {
    const double part = count / double(values.size());
    if (part > 0) bits -= part * std::log2(part);
  }
  return bits;
}

// 1, 2 or 5 times a power of ten.
double nice_step(double raw) {
  const double power = std::pow(10.0, std::floor(std::log10(raw))), digit = raw / power;
  return power * (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10);
}

std::vector<double> linear_ticks(const Scale &scale) {
  std::vector<double> ticks;
  constexpr double told_apart = 1e-9;  // of the larger end
  if (!(scale.high - scale.low > told_apart * std::max(std::abs(scale.low), std::abs(scale.high)))) return {scale.low};
  const double step = nice_step((scale.high - scale.low) / 5);
  for (double k = std::ceil(scale.low / step - 1e-9); k * step <= scale.high * (1 + 1e-12) + 1e-9 * step; k++)
    ticks.push_back(k == 0 ? 0.0 : k * step);
  return ticks;
}

std::vector<double> logarithmic_ticks(const Scale &scale) {
  std::vector<double> ticks;
  const double decades = std::log10(scale.high / scale.low);
  const double every = std::max(1.0, std::ceil(decades / 6));
  for (double e = std::floor(std::log10(scale.low)); e <= std::log10(scale.high); e += every) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double tick = digit * std::pow(10.0, e);
      if ((digit == 1 || decades < 2.5) && tick >= scale.low && tick <= scale.high) ticks.push_back(tick);
    }
  }
  return ticks;
}

// That tell the numbers of a scale apart as well as four do where its ends are far apart; doubles have no more.
int digits_of(const Scale &scale) {
  constexpr int least = 4, most = 15;
  const double part = (scale.high - scale.low) / std::max(std::abs(scale.low), std::abs(scale.high));
  return part > 0 ? std::min(least + int(std::max(0.0, -std::floor(std::log10(part)) - 1)), most) : least;
}

std::string with_short_exponent(const std::string &number) {
  const std::size_t exponent = number.find('e');
  if (exponent == std::string::npos) return number;
  const int power = std::atoi(number.c_str() + exponent + 1);  // without its sign and zeros
  return number.substr(0, exponent + 1) + std::to_string(power);
}

}  // namespace

double Scale::share(double value) const {
  if (!(high > low)) return 0.5;
  const double share =
      logarithmic ? std::log(std::max(value, low) / low) / std::log(high / low) : (value - low) / (high - low);
  return std::clamp(share, 0.0, 1.0);
}

double Scale::value(double share) const {
  return logarithmic ? low * std::pow(high / low, share) : low + share * (high - low);
}

Scale scale_for(const std::vector<double> &values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const Scale linear{*low, *high, false};
  if (*low < 0 || *high <= kManyTimes * *low) return linear;
  const double bits = bits_of(linear, values);
  if (*low == 0 && bits > kHardlyAny) return linear;
  const Scale logarithmic{*low > 0 ? *low : kNextToZero * *high, *high, true};
  return bits_of(logarithmic, values) > bits - kByFar ? logarithmic : linear;
}

std::vector<double> ticks_of(const Scale &scale) {
  return scale.logarithmic ? logarithmic_ticks(scale) : linear_ticks(scale);
}

std::vector<double> with_ends(const Scale &scale, double least_gap) {
  std::vector<double> ticks{scale.low};
  for (const double tick : ticks_of(scale)) {
    const double at = scale.share(tick);
    if (at >= least_gap && at <= 1 - least_gap) ticks.push_back(tick);
  }
  if (scale.high > scale.low) ticks.push_back(scale.high);
  return ticks;
}

std::string count_text(long long count) {
  std::string text = std::to_string(count);
  for (std::size_t at = text.size(); at > 3 && text[at - 4] != '-'; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string shortened(const std::string &name, std::size_t most) {
  if (name.size() <= most) return name;
  const auto inside_letter = [&](std::size_t at) { return (static_cast<unsigned char>(name[at]) & 0xC0U) == 0x80U; };
  std::size_t head = (most - 3) / 2, tail = name.size() - (most - 3 - head);
  while (head > 0 && inside_letter(head)) head--;
  while (tail < name.size() && inside_letter(tail)) tail++;
  return name.substr(0, head) + "..." + name.substr(tail);
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  if (std::abs(std::strtod(text, nullptr)) >= 1e3 && std::abs(value) < 1e8)
    return count_text(std::llround(std::strtod(text, nullptr)));
  return with_short_exponent(text);
}

std::string number_text(double value, const Scale &of) {
  const int digits = digits_of(of);
  if (digits == 4) return number_text(value);
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return with_short_exponent(text);
}

}  // namespace cli
