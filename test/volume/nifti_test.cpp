#include <cstring>

#include "volume/label_image_files_fixture.h"

namespace cfem_cutting {
namespace {

/// A header made by hand: little-endian numbers at offsets.
class Nifti {
 public:
  Nifti(std::size_t size, const std::string& magic, std::size_t magic_offset) : bytes_(size + 4, '\0') {
    put<std::int32_t>(0, {static_cast<std::int32_t>(size)});
    bytes_.replace(magic_offset, magic.size(), magic);
  }

  template <typename T>
  Nifti& put(std::size_t offset, const std::vector<T>& values) {
    std::memcpy(&bytes_[offset], values.data(), values.size() * sizeof(T));
    for (std::size_t n = 0; n < values.size(); ++n) fields_.push_back({offset + n * sizeof(T), sizeof(T)});
    return *this;
  }

  /// The header with its numbers in the other byte order.
  std::string swapped() const {
    std::string bytes = bytes_;
    for (const auto& [offset, size] : fields_)
      std::reverse(bytes.begin() + offset, bytes.begin() + offset + size);
    return bytes;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::vector<std::pair<std::size_t, std::size_t>> fields_;  // offset, size
};

std::string operator+(const Nifti& header, const std::string& data) { return header.bytes() + data; }

using Shorts = std::vector<std::int16_t>;
using Floats = std::vector<float>;

constexpr std::size_t kDim = 40, kDatatype = 70, kPixdim = 76, kVoxOffset = 108, kScale = 112, kUnits = 123,
                      kQform = 252, kSform = 254, kSrow = 280;
constexpr std::int16_t kUint8 = 2, kInt16 = 4, kFloat = 16;

Nifti nifti(std::int16_t datatype = kUint8) {
  return Nifti(348, "n+1", 344)
      .put(kDim, Shorts{3, 3, 2, 1, 1, 1, 1, 1})
      .put(kDatatype, Shorts{datatype})
      .put(kPixdim, Floats{1.0f, 0.5f, 0.6f, 1.25f})
      .put(kVoxOffset, Floats{352.0f});
}

Nifti nifti2() {
  return Nifti(540, "n+2\0\r\n\x1a\n"s, 4)
      .put(12, Shorts{kUint8})
      .put(16, std::vector<std::int64_t>{3, 3, 2, 1, 1, 1, 1, 1})
      .put(104, std::vector<double>{1.0, 0.5, 0.6, 1.25})
      .put(168, std::vector<std::int64_t>{544})
      .put(500, std::vector<std::int32_t>{2});
}

template <typename T>
std::string pixels(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

class NiftiFiles : public LabelImageFiles {};

TEST_F(NiftiFiles, AreReadPlainAndPacked) {
  expect_test_image(read(nifti() + kPixels));
  expect_test_image(read(gzipped(nifti() + kPixels)));
  expect_test_image(read(nifti2() + kPixels));
  expect_test_image(read(gzipped(nifti2() + kPixels)));
}

TEST_F(NiftiFiles, MayHoldIntegersAndRealsOfEitherByteOrder) {
  expect_test_image(read(nifti(kInt16) + pixels(Shorts{1, 2, 3, 4, 5, 255})));
  expect_test_image(read(nifti(1024) + pixels(std::vector<std::int64_t>{1, 2, 3, 4, 5, 255})));
  expect_test_image(read(nifti(1280) + pixels(std::vector<std::uint64_t>{1, 2, 3, 4, 5, 255})));
  expect_test_image(read(nifti(kFloat) + pixels(Floats{1, 2, 3, 4, 5, 255})));
  expect_test_image(read(nifti(64) + pixels(std::vector<double>{1, 2, 3, 4, 5, 255})));
  expect_test_image(read(nifti(kInt16).swapped() + "\0\1\0\2\0\3\0\4\0\5\0\xff"s));
  expect_test_image(read(nifti2().swapped() + kPixels));
}

TEST_F(NiftiFiles, MayHaveFurtherDimensionsOfOneAndExtensions) {
  expect_test_image(read(nifti().put(kDim, Shorts{5, 3, 2, 1, 1, 1}) + kPixels));
  expect_test_image(read(nifti().put(kVoxOffset, Floats{368.0f}) + ("an extension's16" + kPixels)));
  expect_test_image(read(nifti().put(kVoxOffset, Floats{0.0f}) + kPixels));
}

TEST_F(NiftiFiles, SayTheirUnitOfLength) {
  EXPECT_TRUE(read(nifti().put(kUnits, std::vector<std::uint8_t>{2}) + kPixels)
                  .spacing.isApprox(Vec3(0.0005, 0.0006, 0.00125), 1e-6));
  EXPECT_TRUE(read(nifti().put(kUnits, std::vector<std::uint8_t>{1}) + kPixels)
                  .spacing.isApprox(Vec3(0.5, 0.6, 1.25), 1e-6));
  EXPECT_TRUE(read(nifti().put(kUnits, std::vector<std::uint8_t>{3 | 8}) + kPixels)  // µm and seconds
                  .spacing.isApprox(Vec3(0.5e-6, 0.6e-6, 1.25e-6), 1e-6));
  EXPECT_REFUSED(nifti().put(kUnits, std::vector<std::uint8_t>{4}) + kPixels, "xyzt_units is 4");
}

TEST_F(NiftiFiles, AreNeverMirrorImages) {
  const auto placed = [](std::int16_t qform, float qfac, std::int16_t sform, const Floats& srow) {
    return nifti()
        .put(kQform, Shorts{qform})
        .put(kPixdim, Floats{qfac})
        .put(kSform, Shorts{sform})
        .put(kSrow, srow);
  };
  const Floats right{-0.5f, 0, 0, 9, 0, -0.6f, 0, 9, 0, 0, 1.25f, 9};
  const Floats left{-0.5f, 0, 0, 9, 0, 0.6f, 0, 9, 0, 0, 1.25f, 9};
  const Floats turned{0, -0.6f, 0, 9, 0.5f, 0, 0, 9, 0, 0, 1.25f, 9};
  expect_test_image(read(placed(0, -1, 1, right) + kPixels));
  expect_test_image(read(placed(0, -1, 1, turned) + kPixels));
  expect_test_image(read(placed(0, 1, 1, left) + kPixels), kMirrored);
  expect_test_image(read(placed(1, 1, 1, left) + kPixels));
  expect_test_image(read(placed(1, -1, 0, right) + kPixels), kMirrored);
  expect_test_image(read(placed(0, -1, 0, left) + kPixels));  // placed by neither
}

TEST_F(NiftiFiles, AreRefusedIfSheared) {
  const Floats sheared{0.5f, 0.1f, 0, 0, 0, 0.6f, 0, 0, 0, 0, 1.25f, 0};
  EXPECT_REFUSED(nifti().put(kSform, Shorts{1}).put(kSrow, sheared) + kPixels, "sheared");
}

TEST_F(NiftiFiles, AreRefusedIfTruncated) {
  const std::string whole = nifti() + kPixels;
  EXPECT_REFUSED(whole.substr(0, whole.size() - 1), "truncated, 5 bytes of data where 6 are needed");
  EXPECT_REFUSED(whole.substr(0, 200), "truncated, the NIfTI header has no end");
  EXPECT_REFUSED(nifti().put(kVoxOffset, Floats{1e6f}) + kPixels, "truncated, the data begins after");
  const std::string small = gzipped(whole);
  EXPECT_REFUSED(small.substr(0, small.size() - 12), "truncated gzip data");
}

TEST_F(NiftiFiles, AreRefusedIfTheyHoldNoLabels) {
  EXPECT_REFUSED(nifti(kFloat) + pixels(Floats{1, 2, 3, 4, 5, 2.5f}), "label 2.5; labels must be integers");
  EXPECT_REFUSED(nifti(kFloat) + pixels(Floats{1, 2, 3, 4, 5, NAN}), "label nan");
  EXPECT_REFUSED(nifti(kInt16) + pixels(Shorts{1, 2, 3, 4, 5, -1}), "label -1");
  EXPECT_REFUSED(nifti(128) + std::string(18, '\1'), "datatype is 128");  // RGB
  EXPECT_REFUSED(nifti().put(kScale, Floats{0.5f, 1.0f}) + kPixels,
                 "scl_slope and scl_inter are 0.5 and 1; labels must not be scaled");
  expect_test_image(read(nifti().put(kScale, Floats{1.0f, 0.0f}) + kPixels));
}

TEST_F(NiftiFiles, AreRefusedIfTheirHeaderCannotBeServed) {
  EXPECT_REFUSED(nifti().put(kDim, Shorts{4, 3, 2, 1, 5}) + kPixels, "dim is 4 3 2 1 5");
  EXPECT_REFUSED(nifti().put(kDim, Shorts{2, 3, 2}) + kPixels, "three dimensions");
  EXPECT_REFUSED(nifti().put(kDim, Shorts{3, 3, -2, 1}) + kPixels, "at least 1");
  EXPECT_REFUSED(nifti().put(kPixdim, Floats{1, -0.5f}) + kPixels, "spacing");
  EXPECT_REFUSED(Nifti(348, "ni1", 344) + kPixels, "data in another file");
  EXPECT_REFUSED(Nifti(348, "", 344) + kPixels, "ANALYZE");
}

}  // namespace
}  // namespace cfem_cutting
