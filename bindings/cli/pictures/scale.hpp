// Numbers along an axis.
#pragma once

#include <string>
#include <vector>

namespace cli {

struct Scale {
  double low = 0, high = 1;
  bool logarithmic = false;

  // 0 at the low end, 1 at the high one.
  double share(double value) const;
  double value(double share) const;
};

// From the least to the greatest of finite values. Logarithmic where all are above zero and the greatest is many times
// the least, unless that tells them apart worse by far; and from a thousandth of the greatest on where nearly all of
// the others are next to zero. Values below its low end look like that end.
Scale scale_for(const std::vector<double> &values);

// Numbers with few digits between the ends, some five of them.
std::vector<double> ticks_of(const Scale &scale);

// The same and the ends, without ticks that are nearer to an end than that share.
std::vector<double> with_ends(const Scale &scale, double least_gap);

// Four digits: 1.234, 12,340, 3e-9.
std::string number_text(double value);
// The same, or more where numbers of the scale would look alike: 100000.25.
std::string number_text(double value, const Scale &of);
// A name of so many letters at most: of a longer one the beginning and the end.
std::string shortened(const std::string &name, std::size_t most);
// With thousands apart.
std::string count_text(long long count);

}  // namespace cli
