#include "volume/label_image_files_fixture.h"

namespace cfem_cutting {
namespace {

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
                "space directions: (0.3,0.4,0) (-0.48,0.36,0) (0,0,1.25)\n",
                "\0\1\0\2\0\3\0\4\0\5\0\xff"s)));
}

TEST_F(LabelImageFiles, NrrdIsNeverAMirrorImage) {
  const auto read_placed = [&](const std::string& fields) {
    return read(nrrd("type: uchar\nencoding: raw\n" + fields, kPixels));
  };
  const std::string right = "space directions: (0.5,0,0) (0,0.6,0) (0,0,1.25)\n";
  const std::string left = "space directions: (0.5,0,0) (0,0.6,0) (0,0,-1.25)\n";
  expect_test_image(read_placed("space: right-anterior-superior\n" + right));
  expect_test_image(read_placed("space: left-posterior-superior\n" + left), kMirrored);
  expect_test_image(read_placed("space: left-anterior-superior\n" + right), kMirrored);
  expect_test_image(read_placed("space: LAS\n" + left));
}

TEST_F(LabelImageFiles, RefusesMissingAndForeignFiles) {
  EXPECT_THROW(read_label_image("no/such/image.inr"), FileError);
  EXPECT_REFUSED("something else", "not an Inrimage, NRRD, NIfTI or MetaImage file");
  EXPECT_REFUSED("", "not an Inrimage, NRRD, NIfTI or MetaImage file");
}

TEST_F(LabelImageFiles, RefusesTruncatedFiles) {
  const std::string inr = inrimage("unsigned fixed", "8", kPixels);
  EXPECT_REFUSED(inr.substr(0, inr.size() - 1), "truncated, 5 bytes of data where 6 are needed");
  EXPECT_REFUSED(inr.substr(0, 100), "header has no end");
  const std::string small = gzipped(inr);
  EXPECT_REFUSED(small.substr(0, small.size() - 12), "truncated gzip data");
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
  EXPECT_REFUSED(nrrd("type: uchar\nencoding: raw\nspace directions: (1,0,0) (0.1,1,0) (0,0,1)\n", kPixels),
                 "sheared");
  EXPECT_REFUSED(nrrd(kRawBytes + "data file: other.raw\n", ""), "data in another file");
  EXPECT_REFUSED("NRRD0004\ndimension: 2\nsizes: 3 2\n" + kRawBytes + "\n" + kPixels, "dimension is '2'");
  EXPECT_REFUSED("NRRD0004\ndimension: 3\nsizes: 3 0 1\n" + kRawBytes + "\n" + kPixels, "at least 1");
}

}  // namespace
}  // namespace cfem_cutting
