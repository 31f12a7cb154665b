#include <gtest/gtest.h>

#include "common/bus/describe.hpp"
#include "tests/component/bus_examples.hpp"
#include "tests/support/memory_map.hpp"
#include "tests/support/test_bus.hpp"

namespace tsg::test {
namespace {

using namespace std::chrono_literals;

template <typename Tuple>
struct AsTestTypes;
template <typename... Topics>
struct AsTestTypes<std::tuple<Topics...>> {
  using Types = ::testing::Types<Topics...>;
};

template <typename Topic>
class EveryTopic : public ::testing::Test {};
TYPED_TEST_SUITE(EveryTopic, AsTestTypes<topics::All>::Types);

TYPED_TEST(EveryTopic, ArrivesAsItWasSent) {
  TestBus bus;
  Subscriber<TypeParam>& subscriber = bus.subscriber<TypeParam>();
  const auto sent = std::make_unique<typename TypeParam::Message>();
  fill_example(*sent);
  ASSERT_TRUE(bus.publisher<TypeParam>().wait_for_subscribers(1, 5s));
  ASSERT_TRUE(bus.publisher<TypeParam>().publish(*sent));

  const auto received = subscriber.take({}, 5s);
  ASSERT_TRUE(received);
  EXPECT_EQ(to_json(**received), to_json(*sent));
}

template <typename Topic>
class ImageTopic : public ::testing::Test {};
using ImageTopics = ::testing::Types<topics::Rgbd, topics::Instances, topics::Keyframe>;
TYPED_TEST_SUITE(ImageTopic, ImageTopics);

TYPED_TEST(ImageTopic, IsHandedOverInSharedMemoryWithoutACopy) {
  TestBus bus;
  Subscriber<TypeParam>& subscriber = bus.subscriber<TypeParam>();
  Publisher<TypeParam>& publisher = bus.publisher<TypeParam>();
  EXPECT_TRUE(publisher.is_on_shared_memory());
  EXPECT_TRUE(subscriber.is_on_shared_memory());
  ASSERT_TRUE(publisher.wait_for_subscribers(1, 5s));

  auto loan = publisher.loan();
  ASSERT_TRUE(loan);
  const void* written_at = &**loan;
  EXPECT_TRUE(is_in_shared_segment(written_at)) << mapped_file_at(written_at);
  fill_example(**loan);
  const auto expected = to_json(**loan);
  ASSERT_TRUE(publisher.publish(std::move(*loan)));

  const auto received = subscriber.take({}, 5s);
  ASSERT_TRUE(received);
  EXPECT_TRUE(received->is_zero_copy());
  EXPECT_TRUE(is_in_shared_segment(&**received)) << mapped_file_at(&**received);
  EXPECT_EQ(static_cast<const void*>(&**received), written_at);
  EXPECT_EQ(to_json(**received), expected);
}

TEST(MemoryMap, TellsTheHeapFromTheSharedSegment) {
  const auto on_heap = std::make_unique<tsg_RgbdFrame>();
  EXPECT_FALSE(is_in_shared_segment(on_heap.get()));
}

}  // namespace
}  // namespace tsg::test
