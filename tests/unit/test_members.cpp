// What is in a list that grows.
#include <gtest/gtest.h>

#include <random>
#include <set>
#include <vector>

#include "members.hpp"
#include "meshes.hpp"

namespace tetlod {
namespace {

using namespace test;

TEST(Members, AreThoseOfTheList) {
  Host host;
  std::mt19937 random(1);
  for (const int range : {40, 300, 100000}) {
    Members members(host.memory);
    std::vector<std::int32_t> list;
    std::set<std::int32_t> known;
    for (int i = 0; i < 3000; i++) {
      const auto number = std::int32_t(random() % unsigned(range));
      ASSERT_EQ(members.has({list.data(), list.size()}, number), known.count(number) == 1) << list.size();
      if (known.insert(number).second) list.push_back(number);
    }
  }
}

}  // namespace
}  // namespace tetlod
