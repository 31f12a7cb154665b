#pragma once

// What Publisher and Subscriber stand on: endpoints without a type. Services use bus.hpp.

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <type_traits>
#include <utility>

#include "common/bus/bus_config.hpp"
#include "common/bus/dds_entity.hpp"
#include "common/bus/messages.hpp"
#include "common/bus/pools.hpp"
#include "common/bus/qos.hpp"
#include "common/bus/waiter.hpp"
#include "common/core/error.hpp"

struct ddsi_serdata;

namespace tsg {

/// A topic at run time.
struct TopicSpec {
  const char* name = nullptr;
  const dds_topic_descriptor_t* descriptor = nullptr;
  Qos qos;
};

/// The run-time form of a topic of topics.hpp; does not compile for a shared-memory topic that
/// could never be handed over through the pools of config/roudi.toml.
template <typename Topic>
[[nodiscard]] TopicSpec topic_spec() {
  using Message = typename Topic::Message;
  if constexpr (Topic::kQos.domain == Domain::kSharedMemory) {
    static_assert(Topic::kQos.durability == Durability::kVolatile,
                  "shared memory carries volatile topics only");
    static_assert(fits_a_pool(sizeof(Message)),
                  "no pool of config/roudi.toml has chunks as large as this message");
  }
  return {Topic::kName, &descriptor<Message>(), Topic::kQos};
}

/// The participants of this process.
class BusContext {
 public:
  explicit BusContext(const BusConfig& config);

  [[nodiscard]] const BusConfig& config() const { return config_; }
  [[nodiscard]] std::int32_t participant(Domain domain) const;

 private:
  struct Membership {
    std::shared_ptr<const DdsEntity> domain;
    DdsEntity participant;  // after the domain: goes first
  };
  [[nodiscard]] static Membership join(const BusConfig& config, Domain domain);

  BusConfig config_;
  Membership standard_;
  Membership shared_memory_;
};

/// Memory for one sample: a chunk of shared memory, or of the heap without it. Goes back where it
/// came from unless published. Must not outlive its writer.
class RawLoan {
 public:
  /// `writer` is the owner of a chunk of shared memory, 0 for memory of the heap.
  RawLoan(void* data, std::int32_t writer) : data_(data), writer_(writer) {}
  ~RawLoan();
  RawLoan(RawLoan&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), writer_(other.writer_) {}
  RawLoan& operator=(RawLoan&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(writer_, other.writer_);
    return *this;
  }
  RawLoan(const RawLoan&) = delete;
  RawLoan& operator=(const RawLoan&) = delete;

  [[nodiscard]] void* data() { return data_; }
  [[nodiscard]] bool is_shared() const { return writer_ != 0; }
  /// A chunk that was written belongs to the bus.
  void forget() { data_ = nullptr; }

 private:
  void* data_;
  std::int32_t writer_;
};

/// A received sample, in the writer's chunk of shared memory or deserialised on the heap. Must not
/// outlive its reader.
class RawSample {
 public:
  /// Takes over the reference to `received`.
  RawSample(ddsi_serdata* received, const dds_topic_descriptor_t& descriptor);
  ~RawSample();
  RawSample(RawSample&& other) noexcept;
  RawSample& operator=(RawSample&& other) noexcept;
  RawSample(const RawSample&) = delete;
  RawSample& operator=(const RawSample&) = delete;

  /// Null where the bytes received do not make a sample.
  [[nodiscard]] const void* data() const { return data_; }
  [[nodiscard]] bool is_zero_copy() const { return serdata_ != nullptr; }

 private:
  ddsi_serdata* serdata_ = nullptr;  // owns data_ where it is a chunk
  void* data_ = nullptr;
  const dds_topic_descriptor_t* descriptor_;
};

class RawWriter {
 public:
  RawWriter(BusContext& context, const TopicSpec& spec);

  [[nodiscard]] Expected<RawLoan> loan();
  Expected<void> publish(RawLoan&& loan);
  Expected<void> publish(const void* message);

  bool wait_for_match(int count, std::chrono::milliseconds timeout, const std::stop_token& stop);
  [[nodiscard]] int match_count() const;
  [[nodiscard]] bool is_on_shared_memory() const { return on_shared_memory_; }

 private:
  TopicSpec spec_;
  DdsEntity topic_;
  DdsEntity writer_;
  std::unique_ptr<Waiter> match_waiter_;
  std::unique_ptr<Waiter> settle_waiter_;
  std::uint32_t settled_matches_ = 0;  // of all so far: shared memory has had time to follow
  bool on_shared_memory_ = false;
};

class RawReader {
 public:
  RawReader(BusContext& context, const TopicSpec& spec);

  std::optional<RawSample> take(const std::stop_token& stop, std::chrono::milliseconds timeout);
  std::optional<RawSample> try_take();

  bool wait_for_match(int count, std::chrono::milliseconds timeout, const std::stop_token& stop);
  [[nodiscard]] int match_count() const;
  [[nodiscard]] bool is_on_shared_memory() const { return on_shared_memory_; }

 private:
  TopicSpec spec_;
  DdsEntity topic_;
  DdsEntity reader_;
  DdsEntity unread_;  // condition
  std::unique_ptr<Waiter> data_waiter_;
  std::unique_ptr<Waiter> match_waiter_;
  bool on_shared_memory_ = false;
};

}  // namespace tsg
