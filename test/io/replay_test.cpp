#include "cfem_cutting/io/replay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

std::string poses_refusal(const std::string& text) {
  const std::string path = testing::TempDir() + "poses.csv";
  std::ofstream(path) << text;
  try {
    read_poses_csv(path);
  } catch (const FileError& error) {
    return std::string(error.what()).substr(path.size());
  }
  return "";
}

const std::string kHeader = "t,x,y,z,qx,qy,qz,qw\n";

TEST(Poses, AreRefusedByLineAndColumn) {
  EXPECT_EQ(poses_refusal(kHeader + "0,0,0,0,0,0,0,1\n1,0,zero,0,0,0,0,1\n"),
            ":3: column y: 'zero': must be a finite number");
  EXPECT_EQ(poses_refusal(kHeader + "0,0,0,0,0,0,0,0\n").rfind(":2: columns qx,qy,qz,qw", 0), 0u);
  EXPECT_EQ(poses_refusal(kHeader + "1,0,0,0,0,0,0,1\n1,0,0,0,0,0,0,1\n").rfind(":3: column t: 1: ", 0), 0u);
  EXPECT_EQ(poses_refusal(kHeader + "0,0,-2e6,0,0,0,0,1\n"),
            ":2: column y: -2e6 m: must be within 1000000 m");
  EXPECT_EQ(poses_refusal("x,y\n").rfind(":1: ", 0), 0u);
  EXPECT_EQ(poses_refusal(kHeader), ": holds no poses");
  EXPECT_EQ(poses_refusal(kHeader + "0,0,0,0,0,0,0,2\r\n"), "");
}

TEST(Replay, DocumentationMatchesTheSchema) {
  std::ifstream file(std::filesystem::path(__FILE__).parent_path() / "../../doc/parameters.md");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), parameters_markdown()) << "run: replay --list-parameters > doc/parameters.md";
}

std::string one_line_error(const std::vector<const char*>& arguments) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(replay_main(static_cast<int>(arguments.size()), arguments.data(), nullptr), 2);
  return testing::internal::GetCapturedStderr();
}

TEST(Replay, ExitsWithTwoAndOneLine) {
  for (const auto& arguments : std::vector<std::vector<const char*>>{
           {"replay"},
           {"replay", "--nonsense"},
           {"replay", "--config", "none.yaml", "--out", "x", "--duration", "1"},
           {"replay", "--config", "none.yaml", "--out", "x", "--duration", "1", "--poses", "p.csv"},
           {"replay", "--config", "none.yaml", "--out", "x", "--duration", "-1"}}) {
    const std::string error = one_line_error(arguments);
    EXPECT_EQ(std::count(error.begin(), error.end(), '\n'), 1) << error;
  }
}

}  // namespace
}  // namespace cfem_cutting
