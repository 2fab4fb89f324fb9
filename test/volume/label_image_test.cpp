#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>

#include "cfem_cutting/geometry/errors.h"
#include "cfem_cutting/volume/shapes.h"

namespace cfem_cutting {
namespace {

using std::string_literals::operator""s;

const std::string kPixels = "\x01\x02\x03\x04\x05\xff"s;
const std::vector<std::uint8_t> kLabels{1, 2, 3, 4, 5, 255};

std::string inrimage(const std::string& type, const std::string& bits, const std::string& data) {
  std::string header = "#INRIMAGE-4#{\nXDIM=3\nYDIM=2\nZDIM=1\nVDIM=1\nTYPE=" + type + "\nPIXSIZE=" + bits +
                       " bits\nCPU=decm\nVX=0.5\nVY=0.6\nVZ=1.25\n";
  header.resize(252, '\n');
  return header + "##}\n" + data;
}

std::string nrrd(const std::string& fields, const std::string& data) {
  return "NRRD0004\n# made by hand\ndimension: 3\nsizes: 3 2 1\n" + fields + "\n" + data;
}

const std::string kRawBytes = "type: uchar\nencoding: raw\nspacings: 0.5 0.6 1.25\n";

std::string gzipped(const std::string& data) {
  z_stream stream{};
  deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, data.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<unsigned>(data.size());
  stream.next_out = reinterpret_cast<unsigned char*>(packed.data());
  stream.avail_out = static_cast<unsigned>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

class LabelImageFiles : public testing::Test {
 protected:
  LabelImageFiles()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("cfem_cutting_label_images_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~LabelImageFiles() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& content) const {
    const std::string path = (folder_ / "image").string();
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

void expect_test_image(const LabelImage& image) {
  EXPECT_EQ(image.size, Vec3i(3, 2, 1));
  EXPECT_TRUE(image.spacing.isApprox(Vec3(0.0005, 0.0006, 0.00125)));
  EXPECT_EQ(image.labels, kLabels);
}

#define EXPECT_REFUSED(content, reason) \
  EXPECT_NE(refusal(content).find(reason), std::string::npos) << refusal(content)

TEST_F(LabelImageFiles, ReadsInrimage) {
  expect_test_image(read(inrimage("unsigned fixed", "8", kPixels)));
  expect_test_image(read(gzipped(inrimage("unsigned fixed", "8", kPixels))));
  expect_test_image(read(inrimage("unsigned fixed", "16", "\1\0\2\0\3\0\4\0\5\0\xff\0"s)));
}

TEST_F(LabelImageFiles, ReadsNrrd) {
  expect_test_image(read(nrrd(kRawBytes, kPixels)));
  expect_test_image(read(nrrd("type: uchar\nencoding: gzip\nspacings: 0.5 0.6 1.25\n", gzipped(kPixels))));
  expect_test_image(
      read(nrrd("type: short\nendian: big\nencoding: raw\nspace: left-posterior-superior\n"
                "space directions: (0.3,0.4,0) (0,0.6,0) (0,0,-1.25)\n",
                "\0\1\0\2\0\3\0\4\0\5\0\xff"s)));
}

TEST_F(LabelImageFiles, RefusesMissingAndForeignFiles) {
  EXPECT_THROW(read_label_image("no/such/image.inr"), FileError);
  EXPECT_REFUSED("something else", "neither an Inrimage nor an NRRD file");
  EXPECT_REFUSED("", "neither an Inrimage nor an NRRD file");
}

TEST_F(LabelImageFiles, RefusesTruncatedFiles) {
  const std::string inr = inrimage("unsigned fixed", "8", kPixels);
  EXPECT_REFUSED(inr.substr(0, inr.size() - 1), "truncated, 5 bytes of data where 6 are needed");
  EXPECT_REFUSED(inr.substr(0, 100), "header has no end");
  const std::string packed = gzipped(inr);
  EXPECT_REFUSED(packed.substr(0, packed.size() - 12), "truncated gzip data");
  const std::string raw = nrrd(kRawBytes, kPixels);
  EXPECT_REFUSED(raw.substr(0, raw.size() - 2), "truncated, 4 bytes");
  EXPECT_REFUSED(raw.substr(0, 60), "truncated");
  const std::string inner = nrrd("type: uchar\nencoding: gzip\nspacings: 1 1 1\n", gzipped(kPixels));
  EXPECT_REFUSED(inner.substr(0, inner.size() - 12), "truncated gzip data");
}

TEST_F(LabelImageFiles, RefusesWhatIsNotALabel) {
  EXPECT_REFUSED(inrimage("float", "32", std::string(24, '\0')), "TYPE=float");
  EXPECT_REFUSED(inrimage("unsigned fixed", "16", "\1\0\2\0\3\0\4\0\5\0\0\1"s), "label 256");
  EXPECT_REFUSED(inrimage("signed fixed", "8", kPixels), "label -1");
  EXPECT_REFUSED(nrrd("type: float\nencoding: raw\nspacings: 1 1 1\n", std::string(24, '\0')), "'float'");
}

TEST_F(LabelImageFiles, RefusesHeadersItCannotServe) {
  EXPECT_REFUSED(nrrd("type: uchar\nencoding: bzip2\nspacings: 1 1 1\n", kPixels), "'bzip2'");
  EXPECT_REFUSED(nrrd("type: uchar\nencoding: raw\n", kPixels), "spacings");
  EXPECT_REFUSED(nrrd("type: uchar\nencoding: raw\nspacings: 0 1 1\n", kPixels), "spacing");
  EXPECT_REFUSED(nrrd(kRawBytes + "data file: other.raw\n", ""), "data in another file");
  EXPECT_REFUSED("NRRD0004\ndimension: 2\nsizes: 3 2\n" + kRawBytes + "\n" + kPixels, "dimension is '2'");
  EXPECT_REFUSED("NRRD0004\ndimension: 3\nsizes: 3 0 1\n" + kRawBytes + "\n" + kPixels, "at least 1");
}

}  // namespace
}  // namespace cfem_cutting
