#include "volume/label_image_files_fixture.h"

namespace cfem_cutting {
namespace {

const std::string kSpacing = "ElementSpacing = 0.5 0.6 1.25\n";

std::string meta_image(const std::string& fields, const std::string& type = "MET_UCHAR") {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 3 2 1\n" + fields +
         "ElementType = " + type + "\nElementDataFile = ";
}

std::string local(const std::string& fields, const std::string& data, const std::string& type = "MET_UCHAR") {
  return meta_image(fields, type) + "LOCAL\n" + data;
}

class MetaImageFiles : public LabelImageFiles {};

TEST_F(MetaImageFiles, AreReadPlainAndPacked) {
  expect_test_image(read(local(kSpacing, kPixels)));
  for (const int format : {kZlib, kGzip}) {
    const std::string data = packed(kPixels, format);
    const std::string size = std::to_string(data.size());
    expect_test_image(
        read(local(kSpacing + "CompressedData = True\nCompressedDataSize = " + size + "\n", data)));
  }
  expect_test_image(
      read("NDims = 3\r\nDimSize = 3 2 1\r\nElementSize=0.5 0.6 1.25\r\n"
           "ElementType = MET_UCHAR\r\nElementDataFile = LOCAL\r\n" +
           kPixels));
}

TEST_F(MetaImageFiles, MayHaveTheirDataInAnotherFile) {
  write(kPixels, "image.raw");
  write("two" + kPixels, "late.raw");
  write(packed(kPixels, kZlib), "image.zraw");
  expect_test_image(read(meta_image(kSpacing) + "image.raw\n"));
  expect_test_image(read(meta_image(kSpacing + "HeaderSize = 3\n") + "late.raw\n"));
  expect_test_image(read(meta_image(kSpacing + "HeaderSize = -1\n") + "late.raw\n"));
  expect_test_image(read(meta_image(kSpacing + "CompressedData = True\n") + "image.zraw\n"));
  EXPECT_REFUSED(meta_image(kSpacing) + "none.raw\n",
                 "ElementDataFile is 'none.raw'; it cannot be read from");
  EXPECT_REFUSED(meta_image(kSpacing) + ".\n", "cannot be read");
  EXPECT_REFUSED(meta_image(kSpacing) + "LIST\n", "'LIST'; LOCAL or a single file");
  EXPECT_REFUSED(meta_image(kSpacing) + "slice%03d.raw\n", "a single file");
  EXPECT_REFUSED(meta_image(kSpacing + "HeaderSize = -2\n") + "late.raw\n", "HeaderSize is '-2'");
  EXPECT_REFUSED(meta_image(kSpacing + "HeaderSize = 90\n") + "late.raw\n", "truncated, 0 bytes");
}

TEST_F(MetaImageFiles, MayHoldIntegersAndRealsOfEitherByteOrder) {
  const std::string msb = "BinaryDataByteOrderMSB = True\n", lsb = "BinaryDataByteOrderMSB = False\n";
  expect_test_image(read(local(kSpacing + msb, "\0\1\0\2\0\3\0\4\0\5\0\xff"s, "MET_SHORT")));
  expect_test_image(read(local(kSpacing + lsb, "\1\0\2\0\3\0\4\0\5\0\xff\0"s, "MET_USHORT")));
  expect_test_image(
      read(local(kSpacing + "ElementByteOrderMSB = True\n",
                 "\x3f\x80\0\0\x40\0\0\0\x40\x40\0\0\x40\x80\0\0\x40\xa0\0\0\x43\x7f\0\0"s, "MET_FLOAT")));
}

TEST_F(MetaImageFiles, SayTheirUnitOfLength) {
  expect_test_image(read(local("DistanceUnits = um\nElementSpacing = 500 600 1250\n", kPixels)));
  expect_test_image(read(local("DistanceUnits = cm\nElementSpacing = 0.05 0.06 0.125\n", kPixels)));
  EXPECT_REFUSED(local(kSpacing + "DistanceUnits = inch\n", kPixels), "DistanceUnits is 'inch'");
}

TEST_F(MetaImageFiles, AreNeverMirrorImages) {
  const auto turned = [](const std::string& axes) {
    return local(kSpacing + "TransformMatrix = " + axes + "\nOffset = 1 2 3\n", kPixels);
  };
  expect_test_image(read(turned("0 1 0 -1 0 0 0 0 1")));
  expect_test_image(read(turned("1 0 0 0 1 0 0 0 -1")), kMirrored);
  EXPECT_REFUSED(turned("1 0 0 0.1 1 0 0 0 1"), "sheared");
  EXPECT_REFUSED(turned("0 0 0 0 0 0 0 0 0"), "sheared");
  EXPECT_REFUSED(turned("1 0 0 0 1 0"), "nine numbers are needed");
}

TEST_F(MetaImageFiles, AreRefusedIfTruncated) {
  const std::string whole = local(kSpacing, kPixels);
  EXPECT_REFUSED(whole.substr(0, whole.size() - 1), "truncated, 5 bytes of data where 6 are needed");
  EXPECT_REFUSED(whole.substr(0, 80), "truncated, the MetaImage header");
  EXPECT_REFUSED(local(kSpacing + "CompressedData = True\n", packed(kPixels, kZlib).substr(0, 8)),
                 "truncated gzip data");
}

TEST_F(MetaImageFiles, AreRefusedIfTheirHeaderCannotBeServed) {
  EXPECT_REFUSED(local("", kPixels), "ElementSpacing is missing; three numbers are needed");
  EXPECT_REFUSED(local("ElementSpacing = 1 0 1\n", kPixels), "greater than 0 mm");
  EXPECT_REFUSED(local(kSpacing, kPixels, "MET_LONG"), "ElementType is 'MET_LONG'");
  EXPECT_REFUSED(local(kSpacing + "ElementNumberOfChannels = 3\n", kPixels), "'3'; 1 is read");
  EXPECT_REFUSED(local(kSpacing + "BinaryData = False\n", kPixels), "BinaryData is 'False'");
  EXPECT_REFUSED(local(kSpacing + "NDims = 2\n", kPixels), "NDims is '2'");
  EXPECT_REFUSED("ObjectType = Scene\nElementDataFile = LOCAL\n", "ObjectType is 'Scene'");
}

}  // namespace
}  // namespace cfem_cutting
