#include "services/tsgctl/run/log_tail.hpp"

#include <deque>
#include <fstream>

namespace tsg {

std::string log_tail(const std::filesystem::path& path, std::size_t lines) {
  std::ifstream file(path);
  std::deque<std::string> last;
  for (std::string line; std::getline(file, line);) {
    last.push_back(std::move(line));
    if (last.size() > lines) last.pop_front();
  }
  if (last.empty()) return "    (it wrote nothing)\n";
  std::string text;
  for (const std::string& line : last) text += "    " + line + "\n";
  return text;
}

}  // namespace tsg
