#pragma once
/// One small image of labels, written by hand in every format and read back.

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {

using std::string_literals::operator""s;

inline const std::string kPixels = "\x01\x02\x03\x04\x05\xff"s;
inline const std::vector<std::uint8_t> kLabels{1, 2, 3, 4, 5, 255};
inline const std::vector<std::uint8_t> kMirrored{3, 2, 1, 255, 5, 4};

constexpr int kZlib = 15, kGzip = 15 + 16;

inline std::string packed(const std::string& data, int format) {
  z_stream stream{};
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, format, 8, Z_DEFAULT_STRATEGY);
  std::string out(deflateBound(&stream, data.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<unsigned>(data.size());
  stream.next_out = reinterpret_cast<unsigned char*>(out.data());
  stream.avail_out = static_cast<unsigned>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

inline std::string gzipped(const std::string& data) { return packed(data, kGzip); }

class LabelImageFiles : public testing::Test {
 protected:
  LabelImageFiles()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("cfem_cutting_label_images_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~LabelImageFiles() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& content, const std::string& name = "image") const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path, std::ios::binary) << content;
    return path;
  }
  LabelImage read(const std::string& content) const { return read_label_image(write(content)); }
  std::string refusal(const std::string& content) const {
    try {
      read(content);
    } catch (const FileError& error) {
      return error.what();
    }
    return "accepted";
  }

 private:
  std::filesystem::path folder_;
};

inline void expect_test_image(const LabelImage& image, const std::vector<std::uint8_t>& labels = kLabels) {
  EXPECT_EQ(image.size, Vec3i(3, 2, 1));
  EXPECT_TRUE(image.spacing.isApprox(Vec3(0.0005, 0.0006, 0.00125), 1e-6));
  EXPECT_EQ(image.labels, labels);
}

#define EXPECT_REFUSED(content, reason) \
  EXPECT_NE(refusal(content).find(reason), std::string::npos) << refusal(content)

}  // namespace cfem_cutting
