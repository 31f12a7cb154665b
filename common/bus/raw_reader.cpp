// The only place that looks into Cyclone's serialised samples: a plain dds_take() copies them out
// of shared memory. Cyclone 0.11 has other means (docs/decisions/0001).

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_shm_transport.h>

#include "common/bus/endpoint.hpp"
#include "common/bus/endpoint_setup.hpp"

namespace tsg {
namespace {

bool holds_raw_chunk(const ddsi_serdata& serdata) {
  return serdata.iox_chunk != nullptr &&
         shm_get_data_state(serdata.iox_chunk) == IOX_CHUNK_CONTAINS_RAW_DATA;
}

}  // namespace

RawSample::RawSample(ddsi_serdata* received, const dds_topic_descriptor_t& descriptor)
    : descriptor_(&descriptor) {
  if (holds_raw_chunk(*received)) {
    serdata_ = received;
    data_ = received->iox_chunk;
    return;
  }
  data_ = dds_alloc(descriptor.m_size);  // zeroed, as deserialising into it requires
  const bool is_sound = ddsi_serdata_to_sample(received, data_, nullptr, nullptr);
  ddsi_serdata_unref(received);
  if (!is_sound) {
    dds_free(data_);
    data_ = nullptr;
  }
}

RawSample::~RawSample() {
  if (serdata_ != nullptr) {
    ddsi_serdata_unref(serdata_);
  } else if (data_ != nullptr) {
    dds_sample_free(data_, descriptor_, DDS_FREE_ALL);
  }
}

RawSample::RawSample(RawSample&& other) noexcept
    : serdata_(std::exchange(other.serdata_, nullptr)),
      data_(std::exchange(other.data_, nullptr)),
      descriptor_(other.descriptor_) {}

RawSample& RawSample::operator=(RawSample&& other) noexcept {
  std::swap(serdata_, other.serdata_);
  std::swap(data_, other.data_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

RawReader::RawReader(BusContext& context, const TopicSpec& spec)
    : spec_(spec),
      topic_(create_topic(context, spec)),
      reader_(create_reader(context, spec, topic_)),
      unread_(dds_create_readcondition(reader_.handle(), DDS_ANY_STATE), "a read condition"),
      on_shared_memory_(check_shared_memory(context, spec, reader_, "reader")) {
  dds_set_status_mask(reader_.handle(), DDS_SUBSCRIPTION_MATCHED_STATUS);
  const std::int32_t participant = context.participant(spec.qos.domain);
  data_waiter_ = std::make_unique<Waiter>(participant, unread_.handle());
  match_waiter_ = std::make_unique<Waiter>(participant, reader_.handle());
}

std::optional<RawSample> RawReader::try_take() {
  ddsi_serdata* serdata = nullptr;
  dds_sample_info_t info{};
  while (dds_takecdr(reader_.handle(), &serdata, 1, &info, DDS_ANY_STATE) == 1) {
    if (!info.valid_data) {  // says only that a writer has left
      ddsi_serdata_unref(serdata);
      continue;
    }
    RawSample sample(serdata, *spec_.descriptor);
    if (sample.data() != nullptr) return sample;
  }
  return std::nullopt;
}

std::optional<RawSample> RawReader::take(const std::stop_token& stop,
                                         std::chrono::milliseconds timeout) {
  const auto deadline = Waiter::deadline_after(timeout);
  while (!stop.stop_requested()) {
    if (auto sample = try_take()) return sample;
    if (data_waiter_->wait_until(deadline, stop) != WaitResult::kTriggered) break;
  }
  return std::nullopt;
}

int RawReader::match_count() const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(reader_.handle(), &status);
  return static_cast<int>(status.current_count);
}

bool RawReader::wait_for_match(int count,
                               std::chrono::milliseconds timeout,
                               const std::stop_token& stop) {
  const auto deadline = Waiter::deadline_after(timeout);
  while (match_count() < count) {
    if (match_waiter_->wait_until(deadline, stop) != WaitResult::kTriggered) return false;
  }
  return true;
}

}  // namespace tsg
