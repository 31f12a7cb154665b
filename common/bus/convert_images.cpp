#include <algorithm>
#include <opencv2/core.hpp>
#include <string>

#include "common/bus/convert.hpp"
#include "common/bus/field_text.hpp"
#include "common/core/time.hpp"

namespace tsg {
namespace {

static_assert(kMaxInstances == tsg_MAX_INSTANCES);

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

/// A read-only view as cv::Mat, which knows no const: callers hand it out as part of a const view.
template <typename Pixel>
cv::Mat view(const Pixel* pixels, int width, int height, int type) {
  // NOLINTNEXTLINE(*-const-cast)
  return {height, width, type, const_cast<Pixel*>(pixels)};
}

bool fits(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width * height <= std::int64_t{tsg_MAX_PIXELS};
}

Expected<void> check_capacity(std::int64_t width, std::int64_t height, ExitCode code) {
  if (fits(width, height)) return {};
  return make_error(code, "an image of " + std::to_string(width) + "x" + std::to_string(height) +
                              " pixels does not fit the bus; it carries at most " +
                              std::to_string(tsg_MAX_PIXELS) + " pixels, e.g. " +
                              size_text(tsg_MAX_IMAGE_WIDTH, tsg_MAX_IMAGE_HEIGHT));
}

/// Of RgbdFrame and Keyframe: they name these members alike.
template <typename Message>
Expected<RgbdFrame> view_images(const Message& message) {
  const auto& size = message.intrinsics;
  if (auto fitting = check_capacity(size.width, size.height, ExitCode::kBadData); !fitting) {
    return tl::unexpected(fitting.error());
  }
  RgbdFrame frame;
  frame.camera = to_camera(size);
  if (const auto problems = frame.camera.problems(); !problems.empty()) {
    return make_error(ExitCode::kBadData, "a frame has unusable intrinsics: " + problems.front());
  }
  if (!(message.depth_units_per_metre > 0.0)) {
    return make_error(ExitCode::kBadData, "a frame's depth_units_per_metre is not positive");
  }
  frame.stamp_ns = message.header.stamp_ns;
  frame.depth_units_per_metre = message.depth_units_per_metre;
  frame.colour = view(message.colour, frame.camera.width, frame.camera.height, CV_8UC3);
  frame.depth = view(message.depth, frame.camera.width, frame.camera.height, CV_16UC1);
  return frame;
}

Expected<void> check_images(const RgbdFrame& frame) {
  const CameraModel& camera = frame.camera;
  const cv::Size size(camera.width, camera.height);
  const bool is_sound = frame.colour.type() == CV_8UC3 && frame.depth.type() == CV_16UC1 &&
                        frame.colour.size() == size && frame.depth.size() == size;
  if (!is_sound) {
    return make_error(ExitCode::kSizeMismatch,
                      "colour (" + size_text(frame.colour.cols, frame.colour.rows) +
                          ", BGR) and depth (" + size_text(frame.depth.cols, frame.depth.rows) +
                          ", 16 bits) must be of the camera's size " +
                          size_text(camera.width, camera.height));
  }
  return check_capacity(camera.width, camera.height, ExitCode::kSizeMismatch);
}

template <typename Message>
Expected<void> fill_images(const RgbdFrame& frame, Message& message) {
  if (auto sound = check_images(frame); !sound) return sound;
  message.intrinsics = to_message(frame.camera);
  message.depth_units_per_metre = frame.depth_units_per_metre;
  frame.colour.copyTo(view(message.colour, frame.camera.width, frame.camera.height, CV_8UC3));
  frame.depth.copyTo(view(message.depth, frame.camera.width, frame.camera.height, CV_16UC1));
  message.header.stamp_ns = frame.stamp_ns;
  message.header.publish_monotonic_ns = monotonic_ns();
  return {};
}

/// Of InstanceMask and Keyframe; `labels` is a view into `message`.
template <typename Message>
Expected<InstanceSegmentation> view_labels(const Message& message, const cv::Mat& labels) {
  double largest = 0.0;
  cv::minMaxLoc(labels, nullptr, &largest);
  if (message.instance_count > tsg_MAX_INSTANCES || largest > message.instance_count) {
    return make_error(ExitCode::kBadData,
                      "a mask has label " + std::to_string(static_cast<int>(largest)) + " but " +
                          std::to_string(message.instance_count) + " instances (at most " +
                          std::to_string(tsg_MAX_INSTANCES) + ")");
  }
  InstanceSegmentation segmentation;
  segmentation.stamp_ns = message.header.stamp_ns;
  segmentation.labels = labels;
  std::transform(message.instances, message.instances + message.instance_count,
                 std::back_inserter(segmentation.instances), to_instance);
  return segmentation;
}

template <typename Message>
Expected<void> fill_labels(const InstanceSegmentation& segmentation, Message& message) {
  const cv::Mat& labels = segmentation.labels;
  if (labels.type() != CV_8UC1) {
    return make_error(ExitCode::kSizeMismatch, "a label image must have one 8-bit channel");
  }
  if (auto fitting = check_capacity(labels.cols, labels.rows, ExitCode::kSizeMismatch); !fitting) {
    return fitting;
  }
  if (segmentation.instances.size() > tsg_MAX_INSTANCES) {
    return make_error(ExitCode::kBadData, std::to_string(segmentation.instances.size()) +
                                              " instances in one frame; the bus carries " +
                                              std::to_string(tsg_MAX_INSTANCES) +
                                              ": keep those of highest score");
  }
  std::size_t count = 0;
  for (const Instance& instance : segmentation.instances) {
    auto converted = to_message(instance);
    if (!converted) return tl::unexpected(converted.error());
    message.instances[count++] = *converted;
  }
  message.instance_count = static_cast<std::uint32_t>(count);
  labels.copyTo(view(message.labels, labels.cols, labels.rows, CV_8UC1));
  return {};
}

}  // namespace

Instance to_instance(const tsg_Instance& message) {
  static_assert(tsg_MOTION_STATIC == static_cast<int>(MotionVerdict::kStatic) &&
                tsg_MOTION_MOVING == static_cast<int>(MotionVerdict::kMoving));
  return {.class_name = text_of(message.class_name),
          .score = message.score,
          .box = {cv::Point2f(message.box_min_x, message.box_min_y),
                  cv::Point2f(message.box_max_x, message.box_max_y)},
          .motion = static_cast<MotionVerdict>(message.motion),
          .track_id = message.track_id};
}

Expected<tsg_Instance> to_message(const Instance& instance) {
  tsg_Instance message{};
  if (instance.class_name.size() >= sizeof(message.class_name)) {
    return make_error(ExitCode::kBadData,
                      "class name '" + instance.class_name + "' is longer than " +
                          std::to_string(sizeof(message.class_name) - 1) + " bytes");
  }
  instance.class_name.copy(message.class_name, instance.class_name.size());
  message.score = instance.score;
  message.box_min_x = instance.box.x;
  message.box_min_y = instance.box.y;
  message.box_max_x = instance.box.x + instance.box.width;
  message.box_max_y = instance.box.y + instance.box.height;
  message.motion = static_cast<tsg_MotionVerdict>(instance.motion);
  message.track_id = instance.track_id;
  return message;
}

Expected<RgbdFrame> view_as_frame(const tsg_RgbdFrame& message) {
  auto frame = view_images(message);
  if (frame) frame->seq = message.header.seq;
  return frame;
}

Expected<RgbdFrame> view_as_frame(const tsg_Keyframe& message) {
  auto frame = view_images(message);
  if (frame) frame->seq = message.frame_seq;
  return frame;
}

Expected<void> fill_message(const RgbdFrame& frame, tsg_RgbdFrame& message) {
  message.header.seq = frame.seq;
  return fill_images(frame, message);
}

Expected<void> fill_message(const RgbdFrame& frame, tsg_Keyframe& message) {
  message.frame_seq = frame.seq;
  message.has_labels = false;
  message.instance_count = 0;
  return fill_images(frame, message);
}

Expected<InstanceSegmentation> view_as_instances(const tsg_InstanceMask& message) {
  if (auto fitting = check_capacity(message.width, message.height, ExitCode::kBadData); !fitting) {
    return tl::unexpected(fitting.error());
  }
  const cv::Mat labels = view(message.labels, static_cast<int>(message.width),
                              static_cast<int>(message.height), CV_8UC1);
  auto segmentation = view_labels(message, labels);
  if (segmentation) segmentation->frame_seq = message.header.seq;
  return segmentation;
}

Expected<InstanceSegmentation> view_as_instances(const tsg_Keyframe& message) {
  if (!message.has_labels) {
    return InstanceSegmentation{.frame_seq = message.frame_seq,
                                .stamp_ns = message.header.stamp_ns,
                                .labels = {},
                                .instances = {}};
  }
  const auto& size = message.intrinsics;
  if (auto fitting = check_capacity(size.width, size.height, ExitCode::kBadData); !fitting) {
    return tl::unexpected(fitting.error());
  }
  const cv::Mat labels =
      view(message.labels, static_cast<int>(size.width), static_cast<int>(size.height), CV_8UC1);
  auto segmentation = view_labels(message, labels);
  if (segmentation) segmentation->frame_seq = message.frame_seq;
  return segmentation;
}

Expected<void> fill_message(const InstanceSegmentation& segmentation, tsg_InstanceMask& message) {
  message.header.seq = segmentation.frame_seq;
  message.header.stamp_ns = segmentation.stamp_ns;
  message.width = static_cast<std::uint32_t>(segmentation.labels.cols);
  message.height = static_cast<std::uint32_t>(segmentation.labels.rows);
  auto filled = fill_labels(segmentation, message);
  message.header.publish_monotonic_ns = monotonic_ns();
  return filled;
}

Expected<void> fill_message(const InstanceSegmentation& segmentation, tsg_Keyframe& message) {
  const cv::Size size(static_cast<int>(message.intrinsics.width),
                      static_cast<int>(message.intrinsics.height));
  if (segmentation.labels.size() != size) {
    return make_error(ExitCode::kSizeMismatch,
                      "the labels of a keyframe must be of its frame's size " +
                          size_text(size.width, size.height));
  }
  auto filled = fill_labels(segmentation, message);
  message.has_labels = filled.has_value();
  return filled;
}

}  // namespace tsg
