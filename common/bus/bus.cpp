#include "common/bus/bus.hpp"

#include <dds/dds.h>

#include "common/bus/domain.hpp"
#include "common/bus/roudi.hpp"

namespace tsg {
namespace {

using QosPointer = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

constexpr int kHighestDomain = 230;  // ports of higher ones are out of range (DDSI 2.3, 9.6.1)

bool is_domain_number(int number) { return number >= 0 && number <= kHighestDomain; }

BusConfig checked(const BusConfig& config) {
  std::string all;
  for (const std::string& problem : config.problems()) all += "\n  bus: " + problem;
  if (!all.empty()) throw FatalError(ExitCode::kConfig, "the bus configuration is wrong:" + all);
  if (config.use_shared_memory) throw_on_error(check_roudi());
  return config;
}

}  // namespace

std::vector<std::string> BusConfig::problems() const {
  std::vector<std::string> found;
  if (!is_domain_number(standard_domain)) {
    found.emplace_back("standard_domain must be 0.." + std::to_string(kHighestDomain));
  }
  if (!is_domain_number(shared_memory_domain)) {
    found.emplace_back("shared_memory_domain must be 0.." + std::to_string(kHighestDomain));
  }
  if (standard_domain == shared_memory_domain) {
    found.emplace_back("standard_domain and shared_memory_domain must differ");
  }
  if (interface.empty() || interface.find_first_of("<>&\"'") != std::string::npos) {
    found.emplace_back("interface must be the name of a network interface, e.g. lo");
  }
  return found;
}

BusContext::BusContext(const BusConfig& config)
    : config_(checked(config)),
      standard_(join(config, Domain::kStandard)),
      shared_memory_(join(config, Domain::kSharedMemory)) {}

BusContext::Membership BusContext::join(const BusConfig& config, Domain domain) {
  auto joined = join_domain(config, domain);
  const int id = domain_id(config, domain);
  const QosPointer qos(dds_create_qos(), &dds_delete_qos);
  const std::string transport = config.use_shared_memory ? kSaysSharedMemory : kSaysUdp;
  if (domain == Domain::kSharedMemory) {
    dds_qset_userdata(qos.get(), transport.data(), transport.size());
  }
  DdsEntity participant(dds_create_participant(static_cast<dds_domainid_t>(id), qos.get(), nullptr),
                        "a participant of DDS domain " + std::to_string(id));
  return {std::move(joined), std::move(participant)};
}

std::int32_t BusContext::participant(Domain domain) const {
  return (domain == Domain::kStandard ? standard_ : shared_memory_).participant.handle();
}

Bus::Bus(const BusConfig& config) : context_(std::make_unique<BusContext>(config)) {}

Bus::~Bus() = default;

}  // namespace tsg
