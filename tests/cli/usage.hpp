// Wrong usage ends with status 2, everything else that fails with 1; either way one line on stderr, nothing on stdout
// and no file.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mesh_file.hpp"
#include "tool.hpp"

namespace cli_test {

inline void expect_failure(const Outcome &outcome, int status, const std::string &said) {
  EXPECT_EQ(outcome.status, status) << outcome.err;
  EXPECT_EQ(lines_of(outcome.err), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("tetlod: ", 0), 0U) << outcome.err;
  EXPECT_NE(outcome.err.find(said), std::string::npos) << "'" << said << "' is not in: " << outcome.err;
}

class Usage : public testing::Test {
 protected:
  // The cube's file, and arguments after it.
  Outcome run_on(const Cube &cube, std::vector<std::string> more = {}) {
    write_cube(folder / "in.vtk", cube);
    more.insert(more.begin(), {folder / "in.vtk", folder / "out.vtu"});
    return run_tool(more);
  }
  void expect_only_input() { EXPECT_EQ(folder.names(), std::vector<std::string>{"in.vtk"}); }

  Folder folder;
};

}  // namespace cli_test
