#include "services/segmentation/lib/decoders/class_names.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_folder.hpp"

namespace tsg {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ClassNames, MayBeInEitherQuoteAndHoldEscapes) {
  const auto names = parse_class_names(R"({0: 'hot dog', 1: "driver's \"seat\"", 2:'it\'s'})");
  ASSERT_TRUE(names.has_value()) << names.error().message;
  EXPECT_THAT(*names, ElementsAre("hot dog", "driver's \"seat\"", "it's"));
}

TEST(ClassNames, AreRejectedWhereNotADictionaryInOrder) {
  for (const char* text : {"", "{", "{}", "person", "{1: 'person'}", "{0: 'a', 2: 'b'}", "{0: 'a'",
                           "{0: 'a', }", "{0: a}", "{0: 'a}", "{0: ''}", "{x: 'a'}"}) {
    const auto names = parse_class_names(text);
    ASSERT_FALSE(names.has_value()) << text;
    EXPECT_EQ(names.error().code, ExitCode::kUnsupportedModel);
  }
}

TEST(ClassNames, AreRejectedWhereAMessageHasNoRoomForThem) {
  EXPECT_TRUE(parse_class_names("{0: '" + std::string(31, 'a') + "'}").has_value());
  const auto names = parse_class_names("{0: '" + std::string(32, 'a') + "'}");
  ASSERT_FALSE(names.has_value());
  EXPECT_EQ(names.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(names.error().message, HasSubstr("31 bytes"));
}

TEST(ClassNames, AreThoseOfTheMetadata) {
  const auto names = class_names_of({.metadata = {{"names", "{0: 'person', 1: 'tv'}"}}});
  ASSERT_TRUE(names.has_value()) << names.error().message;
  EXPECT_THAT(names->names, ElementsAre("person", "tv"));
}

TEST(ClassNames, HaveAFixWhereTheMetadataHasNone) {
  const auto names = class_names_of({});
  ASSERT_FALSE(names.has_value());
  EXPECT_EQ(names.error().code, ExitCode::kUnsupportedModel);
  EXPECT_THAT(names.error().message, HasSubstr("segmentation.model.labels"));
}

void expect_labels_error(const std::filesystem::path& file,
                         ExitCode code,
                         const std::string& said) {
  const auto names = read_labels_file(file);
  ASSERT_FALSE(names.has_value()) << file;
  EXPECT_EQ(names.error().code, code) << names.error().message;
  EXPECT_THAT(names.error().message, HasSubstr(file.string()));
  EXPECT_THAT(names.error().message, HasSubstr(said));
}

TEST(LabelsFile, HasOneNameOnEachLine) {
  const test::TempFolder folder;
  for (const char* text :
       {"person\ndining table\n", "person\ndining table", "person\r\ndining table\r\n"}) {
    const auto names = read_labels_file(folder.write("labels.txt", text));
    ASSERT_TRUE(names.has_value()) << names.error().message;
    EXPECT_THAT(names->names, ElementsAre("person", "dining table"));
    EXPECT_EQ(names->fault, ExitCode::kBadData);
  }
}

TEST(LabelsFile, IsRejectedWhereAbsentEmptyOrDamaged) {
  const test::TempFolder folder;
  expect_labels_error("/nowhere/labels.txt", ExitCode::kMissingInput, "segmentation.model.labels");
  expect_labels_error(folder.write("empty.txt", ""), ExitCode::kEmptyInput, "is empty");
  expect_labels_error(folder.write("gap.txt", "person\n \ntv\n"), ExitCode::kBadData,
                      "gap.txt:2: a line without a name");
  expect_labels_error(folder.write("blank.txt", "\n"), ExitCode::kBadData, "blank.txt:1");
  expect_labels_error(folder.write("long.txt", "person\n" + std::string(32, 'a')),
                      ExitCode::kBadData, "long.txt:2: the class name 'aaa");
}

TEST(ClassNames, AreToBeAsManyAsTheNetworkHasClasses) {
  const ClassNames names{{"person", "tv"}, "the labels file two.txt", ExitCode::kBadData};
  EXPECT_TRUE(check_class_count(names, 2).has_value());
  for (const int classes : {1, 3}) {
    const auto checked = check_class_count(names, classes);
    ASSERT_FALSE(checked.has_value());
    EXPECT_EQ(checked.error().code, ExitCode::kBadData);
    EXPECT_THAT(checked.error().message, HasSubstr("the labels file two.txt names 2"));
  }
}

}  // namespace
}  // namespace tsg
