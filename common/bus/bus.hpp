#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "common/bus/bus_config.hpp"
#include "common/bus/endpoint.hpp"
#include "common/bus/qos.hpp"
#include "common/core/error.hpp"

namespace tsg {

/// This process's place on the bus: one participant in each domain. Outlives its endpoints.
class Bus {
 public:
  /// Throws FatalError: kUnavailable where RouDi does not answer (checked before DDS is touched,
  /// which would block for a minute).
  explicit Bus(const BusConfig& config);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  Bus(Bus&&) = delete;
  Bus& operator=(Bus&&) = delete;

  [[nodiscard]] BusContext& context() { return *context_; }

 private:
  std::unique_ptr<BusContext> context_;
};

/// A sample of `Topic` in shared memory, being filled: given to Publisher::publish() or, at the
/// end of its scope, back to the pool.
template <typename Topic>
class Loan {
 public:
  explicit Loan(RawLoan raw) : raw_(std::move(raw)) {}
  typename Topic::Message& operator*() {
    return *static_cast<typename Topic::Message*>(raw_.data());
  }
  typename Topic::Message* operator->() { return &**this; }

 private:
  template <typename>
  friend class Publisher;
  RawLoan raw_;
};

/// A received sample, read only; the memory goes back at the end of its scope. Never stored:
/// whoever keeps pixels copies them.
template <typename Topic>
class Sample {
 public:
  explicit Sample(RawSample raw) : raw_(std::move(raw)) {}
  const typename Topic::Message& operator*() const {
    return *static_cast<const typename Topic::Message*>(raw_.data());
  }
  const typename Topic::Message* operator->() const { return &**this; }
  /// True where the data lies in the shared segment, i.e. nothing was copied on the way.
  [[nodiscard]] bool is_zero_copy() const { return raw_.is_zero_copy(); }

 private:
  RawSample raw_;
};

/// Writes `Topic`. Not thread-safe: one owner.
template <typename Topic>
class Publisher {
 public:
  using Message = typename Topic::Message;

  /// Throws FatalError where the endpoint cannot be made; warns on stderr, loudly, where a
  /// shared-memory topic is not on shared memory.
  explicit Publisher(Bus& bus) : writer_(bus.context(), topic_spec<Topic>()) {}

  /// Memory for one sample, NOT zeroed; kUnavailable where the pool is exhausted (drop the frame
  /// and count it). Without shared memory the loan is on the heap.
  [[nodiscard]] Expected<Loan<Topic>> loan() requires(Topic::kQos.domain == Domain::kSharedMemory) {
    return writer_.loan().map([](RawLoan&& raw) { return Loan<Topic>(std::move(raw)); });
  }

  /// Hands a filled loan to the readers without a copy.
  Expected<void> publish(Loan<Topic>&& loan) { return writer_.publish(std::move(loan.raw_)); }

  /// Serialises and sends; for the standard domain. Pointers in `message` are only read.
  Expected<void> publish(const Message& message) { return writer_.publish(&message); }

  /// True once at least `count` readers are matched; false on timeout or stop. Shared-memory
  /// topics must wait before their first write (what is written before discovery is lost).
  bool wait_for_subscribers(int count,
                            std::chrono::milliseconds timeout,
                            const std::stop_token& stop = {}) {
    return writer_.wait_for_match(count, timeout, stop);
  }
  [[nodiscard]] int subscriber_count() const { return writer_.match_count(); }
  [[nodiscard]] bool is_on_shared_memory() const { return writer_.is_on_shared_memory(); }

 private:
  RawWriter writer_;
};

/// Reads `Topic`. Not thread-safe: one owner.
template <typename Topic>
class Subscriber {
 public:
  explicit Subscriber(Bus& bus) : reader_(bus.context(), topic_spec<Topic>()) {}

  /// The oldest unread sample, waiting for one; nothing on stop or timeout.
  std::optional<Sample<Topic>> take(const std::stop_token& stop,
                                    std::chrono::milliseconds timeout) {
    return wrap(reader_.take(stop, timeout));
  }
  /// The oldest unread sample if there is one.
  std::optional<Sample<Topic>> try_take() { return wrap(reader_.try_take()); }

  /// The newest unread sample, waiting for one; what is older is passed over and counted.
  std::optional<Sample<Topic>> take_latest(const std::stop_token& stop,
                                           std::chrono::milliseconds timeout) {
    auto newest = take(stop, timeout);
    while (newest) {
      auto newer = try_take();
      if (!newer) break;
      ++passed_over_;
      newest = std::move(newer);
    }
    return newest;
  }

  /// Samples that the bus dropped because this reader was slow: holes in header.seq (0 for
  /// messages without our header). Counted from the first sample received.
  [[nodiscard]] std::uint64_t missed() const { return missed_; }
  /// Samples that take_latest() left unread.
  [[nodiscard]] std::uint64_t passed_over() const { return passed_over_; }

  bool wait_for_publishers(int count,
                           std::chrono::milliseconds timeout,
                           const std::stop_token& stop = {}) {
    return reader_.wait_for_match(count, timeout, stop);
  }
  [[nodiscard]] int publisher_count() const { return reader_.match_count(); }
  [[nodiscard]] bool is_on_shared_memory() const { return reader_.is_on_shared_memory(); }

 private:
  std::optional<Sample<Topic>> wrap(std::optional<RawSample> raw);  // counts holes

  RawReader reader_;
  std::uint64_t missed_ = 0;
  std::uint64_t passed_over_ = 0;
  std::optional<std::uint64_t> last_seq_;
};

template <typename Topic>
std::optional<Sample<Topic>> Subscriber<Topic>::wrap(std::optional<RawSample> raw) {
  if (!raw) return std::nullopt;
  Sample<Topic> sample(std::move(*raw));
  if constexpr (requires { sample->header.seq; }) {
    const std::uint64_t seq = sample->header.seq;
    // A smaller number means that the publisher has started anew.
    if (last_seq_ && seq > *last_seq_ + 1) missed_ += seq - *last_seq_ - 1;
    last_seq_ = seq;
  }
  return sample;
}

}  // namespace tsg
