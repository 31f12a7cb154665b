#include "common/scene_file/scene_problems.hpp"

#include <algorithm>
#include <numeric>

#include "common/dataset/text_file.hpp"

namespace tsg {
namespace {

/// Letters to insert, remove or replace to make one word of the other (Levenshtein).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0]++;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

bool is_near(const std::string& word, const std::string& known) {
  const bool is_beginning = word.size() >= 2 && known.starts_with(word);
  return is_beginning || edit_distance(word, known) <= std::max<std::size_t>(1, word.size() / 2);
}

}  // namespace

SceneProblems::SceneProblems(std::filesystem::path file) : file_(std::move(file)) {}

void SceneProblems::add(int line, const std::string& key, const std::string& what) {
  lines_.emplace_back(line, place(file_, line) + ": " + (key.empty() ? "" : key + ": ") + what);
}

Error SceneProblems::to_error() const {
  auto sorted = lines_;
  std::ranges::stable_sort(sorted, {}, &std::pair<int, std::string>::first);
  std::string message = "the scene has " + std::to_string(sorted.size()) +
                        (sorted.size() == 1 ? " problem:" : " problems:");
  for (const auto& [line, text] : sorted) message += "\n  " + text;
  return {ExitCode::kConfig, message};
}

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  const auto nearest = std::ranges::min_element(
      known, {}, [&](const std::string& candidate) { return edit_distance(word, candidate); });
  if (nearest != known.end() && is_near(word, *nearest)) return "did you mean " + *nearest + "?";
  const auto beginning =
      std::ranges::find_if(known, [&](const auto& candidate) { return is_near(word, candidate); });
  if (beginning != known.end()) return "did you mean " + *beginning + "?";
  if (known.empty()) return "there is none";
  std::string all = "known:";
  for (const std::string& candidate : known) all += " " + candidate;
  return all;
}

}  // namespace tsg
