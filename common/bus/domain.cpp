#include "common/bus/domain.hpp"

#include <dds/dds.h>

#include <map>
#include <mutex>

namespace tsg {
namespace {

/// What this process has joined so far.
struct JoinedDomains {
  struct Entry {
    std::string xml;
    std::weak_ptr<const DdsEntity> domain;
  };
  std::mutex mutex;  // guards by_id
  std::map<int, Entry> by_id;
};

JoinedDomains& joined_domains() {
  static JoinedDomains domains;
  return domains;
}

std::string interface_xml(const std::string& name) {
  // The loopback interface does not claim multicast but does it: without this attribute Cyclone
  // falls back to asking each peer by its port number.
  const char* multicast = name == "lo" ? " multicast=\"true\"" : "";
  return "<NetworkInterface name=\"" + name + "\"" + multicast + "/>";
}

/// What a domain runs over. Beside another interface always lo, so that this host's processes hear
/// each other when that one goes down.
std::string transport_xml(const std::string& interface) {
  if (interface == "lo") return "<Interfaces>" + interface_xml("lo") + "</Interfaces>";
  // Packets that fit Ethernet's: of one that the network has to cut up, each part that is lost
  // takes all others along. Multicast for discovery only: on Wi-Fi it is slow and unreliable.
  return "<Interfaces>" + interface_xml("lo") + interface_xml(interface) +
         "</Interfaces><AllowMulticast>spdp</AllowMulticast>"
         "<MaxMessageSize>1400B</MaxMessageSize><FragmentSize>1300B</FragmentSize>";
}

}  // namespace

int domain_id(const BusConfig& config, Domain domain) {
  return domain == Domain::kStandard ? config.standard_domain : config.shared_memory_domain;
}

std::string domain_xml(const BusConfig& config, Domain domain) {
  const bool is_standard = domain == Domain::kStandard;
  const std::string id = std::to_string(domain_id(config, domain));
  std::string xml = "<CycloneDDS><Domain Id=\"" + id + "\"><General>" +
                    transport_xml(is_standard ? config.interface : "lo") +
                    "</General><Discovery><LeaseDuration>2s</LeaseDuration></Discovery>";
  if (!is_standard && config.use_shared_memory) {
    // The prefix keeps topics of one name in two domains apart, which iceoryx would mix up.
    xml += "<SharedMemory><Enable>true</Enable><Prefix>TSG" + id +
           "</Prefix><LogLevel>warn</LogLevel></SharedMemory>";
  }
  return xml + "</Domain></CycloneDDS>";
}

std::shared_ptr<const DdsEntity> join_domain(const BusConfig& config, Domain domain) {
  const int id = domain_id(config, domain);
  const std::string xml = domain_xml(config, domain);
  JoinedDomains& domains = joined_domains();
  const std::scoped_lock lock(domains.mutex);
  auto& entry = domains.by_id[id];
  if (auto existing = entry.domain.lock()) {
    if (entry.xml == xml) return existing;
    throw FatalError(ExitCode::kConfig,
                     "DDS domain " + std::to_string(id) +
                         " is in use in this process with another configuration; give both the "
                         "same section 'bus' or other domain numbers");
  }
  auto created = std::make_shared<const DdsEntity>(
      dds_create_domain(static_cast<dds_domainid_t>(id), xml.c_str()),
      "DDS domain " + std::to_string(id) + " on interface '" + config.interface +
          "' (check bus.interface against 'ip link')");
  entry = {xml, created};
  return created;
}

}  // namespace tsg
