#include <dds/dds.h>
#include <dds/ddsc/dds_loan_api.h>

#include <string>

#include "common/bus/endpoint.hpp"
#include "common/bus/endpoint_setup.hpp"

namespace tsg {
namespace {

// iceoryx follows a match of DDS with its own discovery, which RouDi runs every 100 ms. What is
// written before it has is lost, and its chunks stay with the reader.
constexpr std::chrono::milliseconds kSettleTime{250};

}  // namespace

RawLoan::~RawLoan() {
  if (data_ == nullptr) return;
  if (is_shared()) {
    dds_return_loan(writer_, &data_, 1);
  } else {
    dds_free(data_);
  }
}

RawWriter::RawWriter(BusContext& context, const TopicSpec& spec)
    : spec_(spec),
      topic_(create_topic(context, spec)),
      writer_(create_writer(context, spec, topic_)),
      on_shared_memory_(check_shared_memory(context, spec, writer_, "writer")) {
  dds_set_status_mask(writer_.handle(), DDS_PUBLICATION_MATCHED_STATUS);
  const std::int32_t participant = context.participant(spec.qos.domain);
  match_waiter_ = std::make_unique<Waiter>(participant, writer_.handle());
  settle_waiter_ = std::make_unique<Waiter>(participant, 0);
}

Expected<RawLoan> RawWriter::loan() {
  if (!on_shared_memory_) return RawLoan(dds_alloc(spec_.descriptor->m_size), 0);
  void* chunk = nullptr;
  const dds_return_t result = dds_loan_sample(writer_.handle(), &chunk);
  if (result == DDS_RETCODE_OK) return RawLoan(chunk, writer_.handle());
  return make_error(ExitCode::kUnavailable,
                    std::string("no shared memory is free for a sample of topic '") + spec_.name +
                        "': readers hold every chunk of its pool; find the reader that keeps "
                        "samples, or raise the pool's count in config/roudi.toml");
}

Expected<void> RawWriter::publish(RawLoan&& loan) {
  RawLoan owned = std::move(loan);
  auto result = publish(owned.data());
  // Written or not, DDS has taken a shared chunk out of its list of loans.
  if (owned.is_shared()) owned.forget();
  return result;
}

Expected<void> RawWriter::publish(const void* message) {
  const dds_return_t result = dds_write(writer_.handle(), message);
  if (result == DDS_RETCODE_OK) return {};
  Error error = dds_error(std::string("cannot publish on topic '") + spec_.name + "'", result);
  if (result == DDS_RETCODE_TIMEOUT) {
    error.code = ExitCode::kTimeout;
    error.message += "; a reader of it does not keep up";
  }
  return tl::unexpected(error);
}

int RawWriter::match_count() const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(writer_.handle(), &status);
  return static_cast<int>(status.current_count);
}

bool RawWriter::wait_for_match(int count,
                               std::chrono::milliseconds timeout,
                               const std::stop_token& stop) {
  const auto deadline = Waiter::deadline_after(timeout);
  while (match_count() < count) {
    if (match_waiter_->wait_until(deadline, stop) != WaitResult::kTriggered) return false;
  }
  // All that ever were, not those at present: a reader that starts anew has to settle anew.
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(writer_.handle(), &status);
  if (!on_shared_memory_ || settled_matches_ == status.total_count) return true;
  if (settle_waiter_->wait_until(Waiter::deadline_after(kSettleTime), stop) ==
      WaitResult::kStopped) {
    return false;
  }
  settled_matches_ = status.total_count;
  return true;
}

}  // namespace tsg
