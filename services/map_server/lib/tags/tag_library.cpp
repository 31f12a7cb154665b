#include "services/map_server/lib/tags/tag_library.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "services/map_server/lib/tags/instance_cleaning.hpp"
#include "services/map_server/lib/tags/tag_matching.hpp"

namespace tsg {
namespace {

/// Looks in a row that must find a place free: a person may stand there when the first is taken.
constexpr int kFreeChecks = 3;
/// Above this share of free space, the free part is cut off: what was smeared while it was pushed.
constexpr double kSmearedShare = 0.25;
/// A tag appeared where so much of its place had been seen free before.
constexpr double kAppearedShare = 0.5;
/// Sizes of one object, seen at two places, differ by no more.
constexpr float kSameSize = 1.35F;
/// Sightings that are no objects yet; when there are more, the oldest are forgotten.
constexpr std::size_t kMaxGlimpses = 500;
/// Two tags of different classes that share so much both ways are one thing with two names.
constexpr double kSameThingShare = 0.5;

float longest(const Eigen::AlignedBox3f& box) { return box.sizes().maxCoeff(); }

bool are_of_one_size(const Eigen::AlignedBox3f& a, const Eigen::AlignedBox3f& b) {
  return longest(a) <= kSameSize * longest(b) && longest(b) <= kSameSize * longest(a);
}

/// Whether an object that is gone may be the one that stands at `other`'s place.
bool may_be_it(const TagRecord& other, const TagRecord& gone) {
  if (other.first_seen_ns <= gone.last_seen_ns) return false;
  if (other.track_id != 0 && other.track_id == gone.track_id) return true;
  return other.appeared && are_of_one_size(other.box, gone.box);
}

Tag to_tag(const TagRecord& record) {
  Tag tag;
  tag.id = record.id;
  tag.class_name = record.class_name;
  tag.cloud = record.cells.to_cloud(record.class_id);
  if (!record.shape) record.shape = measure_shape(record.cells);
  tag.box = record.shape->box;
  tag.oriented_box = record.shape->oriented_box;
  tag.centre = tag.oriented_box.centre;
  tag.observations = static_cast<int>(record.sightings.size());
  tag.confidence = static_cast<float>(1.0 - record.doubt);
  tag.first_seen_ns = record.first_seen_ns;
  tag.last_seen_ns = record.last_seen_ns;
  tag.state = record.state;
  return tag;
}

}  // namespace

void TagLibrary::add(const KeyframeView& view, const SE3& T_world_camera, const PlaceOf& place_of) {
  is_listed_ = false;
  ++keyframes_;
  const Eigen::Isometry3f T = T_world_camera.to_isometry().cast<float>();
  retract_moving(view);
  const std::vector<SeenInstance> seen = clean(view, T);
  const auto record_of = match(seen, records_, config_);
  std::vector<std::uint32_t> changed;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (record_of[i]) {
      fuse(*record_of[i], seen[i], view);
      changed.push_back(records_[*record_of[i]].id);
    } else {
      insert(seen[i], view, place_of);
    }
  }
  for (const std::uint32_t id : changed) merge_with_others(id);
  check_places(view, ViewVolume(view, T), place_of);
  join_gone_with_appeared();
  forget_oldest_glimpses();
}

std::vector<SeenInstance> TagLibrary::clean(const KeyframeView& view,
                                            const Eigen::Isometry3f& T_world_camera) const {
  std::vector<SeenInstance> all;
  for (std::size_t i = 0; i < view.instances.size(); ++i) {
    Cloud points = clean_instance(view.instances[i].points);
    std::uint64_t pixels = 0;
    for (CloudPoint& point : points) {
      point.position = T_world_camera * point.position;
      pixels += point.weight;
    }
    if (pixels < static_cast<std::uint64_t>(config_.min_points)) continue;
    SeenInstance seen{static_cast<std::uint32_t>(i),
                      &view.instances[i].instance,
                      points.front().class_id,
                      TagCells(config_.voxel_m, points, T_world_camera.translation()),
                      {}};
    seen.box = rough_box(seen.cells);
    all.push_back(std::move(seen));
  }
  return all;
}

void TagLibrary::retract_moving(const KeyframeView& view) {
  for (const InstanceView& shown : view.instances) {
    const Instance& instance = shown.instance;
    if (instance.motion != MotionVerdict::kMoving || instance.track_id == 0) continue;
    for (TagRecord& record : records_) {
      const bool is_it = record.track_id == instance.track_id && is_present(record) &&
                         record.class_name == instance.class_name;
      if (!is_it) continue;
      record.state = TagState::kGone;
    }
  }
}

void TagLibrary::fuse(std::size_t record, const SeenInstance& seen, const KeyframeView& view) {
  TagRecord& tag = records_[record];
  if (!is_present(tag)) {  // it is back, or was never away
    const bool is_as_before =
        share_within(seen.cells, tag.cells, kOverlapSamples) >= config_.merge_overlap;
    if (is_as_before) {
      tag.state = tag.has_moved ? TagState::kMoved : TagState::kStatic;
    } else {
      put_elsewhere(tag);
    }
  }
  take_in(tag, seen, view.id, view.stamp_ns);
  finish_cells(tag, static_cast<std::size_t>(config_.max_voxels));
}

void TagLibrary::insert(const SeenInstance& seen,
                        const KeyframeView& view,
                        const PlaceOf& place_of) {
  TagRecord* moved = find_moved(seen);
  if (moved != nullptr) {
    put_elsewhere(*moved);
  } else {
    records_.push_back({.id = next_id_++,
                        .class_name = seen.instance->class_name,
                        .class_id = seen.class_id,
                        .cells = TagCells(config_.voxel_m),
                        .first_seen_ns = view.stamp_ns,
                        .appeared = places_of(seen.cells, place_of).free >= kAppearedShare});
    moved = &records_.back();
  }
  take_in(*moved, seen, view.id, view.stamp_ns);
  finish_cells(*moved, static_cast<std::size_t>(config_.max_voxels));
}

TagRecord* TagLibrary::find_moved(const SeenInstance& seen) {
  if (seen.instance->track_id == 0) return nullptr;
  const auto found = std::find_if(records_.begin(), records_.end(), [&](const TagRecord& record) {
    return !is_present(record) && record.track_id == seen.instance->track_id &&
           record.class_name == seen.instance->class_name;
  });
  return found == records_.end() ? nullptr : &*found;
}

void TagLibrary::merge_with_others(std::uint32_t id) {
  TagRecord* record = find(id);
  if (record == nullptr || !is_present(*record)) return;  // merged already
  for (std::size_t i = 0; i < records_.size(); ++i) {
    TagRecord& other = records_[i];
    if (other.id == record->id || !is_present(other)) continue;
    if (!are_one_object(*record, other, config_)) continue;
    TagRecord& older = other.id < record->id ? other : *record;
    const TagRecord& younger = other.id < record->id ? *record : other;
    take_in(older, younger);
    finish_cells(older, static_cast<std::size_t>(config_.max_voxels));
    const std::uint32_t kept = older.id;
    records_.erase(records_.begin() + (&younger - records_.data()));
    merge_with_others(kept);
    return;
  }
}

void TagLibrary::check_places(const KeyframeView& view,
                              const ViewVolume& volume,
                              const PlaceOf& place_of) {
  std::vector<TagRecord*> due;
  for (TagRecord& record : records_) {
    const bool is_seen = record.sightings.back().keyframe == view.id;
    if (is_present(record) && !is_seen && volume.holds(record.box.center())) {
      due.push_back(&record);
    }
  }
  std::stable_sort(due.begin(), due.end(), [](const TagRecord* a, const TagRecord* b) {
    return a->last_check < b->last_check;
  });
  due.resize(std::min(due.size(), static_cast<std::size_t>(config_.checks_per_keyframe)));
  for (TagRecord* record : due) check_place(*record, place_of);
}

void TagLibrary::check_place(TagRecord& record, const PlaceOf& place_of) {
  record.last_check = keyframes_;
  const PlaceShares shares = places_of(record.cells, place_of);
  const bool is_free = shares.occupied < config_.gone_share && shares.free > shares.occupied;
  record.free_checks = is_free ? record.free_checks + 1 : 0;
  if (record.free_checks >= kFreeChecks) {
    record.state = TagState::kGone;
  } else if (!is_free && shares.free > kSmearedShare) {
    record.cells.remove_if(
        [&](const TagCell& cell) { return place_of(cell.position) == Place::kFree; });
    finish_cells(record, static_cast<std::size_t>(config_.max_voxels));
  }
}

void TagLibrary::join_gone_with_appeared() {
  for (std::size_t i = 0; i < records_.size(); ++i) {
    TagRecord& gone = records_[i];
    if (is_present(gone) || !is_sure(gone)) continue;
    std::vector<std::size_t> heirs;
    std::size_t gone_alike = 0;
    for (std::size_t k = 0; k < records_.size(); ++k) {
      const TagRecord& other = records_[k];
      if (other.class_name != gone.class_name || !is_sure(other)) continue;
      if (!is_present(other)) {
        ++gone_alike;
      } else if (may_be_it(other, gone)) {
        heirs.push_back(k);
      }
    }
    if (heirs.size() != 1 || gone_alike != 1) continue;  // not sure which is which
    TagRecord heir = std::move(records_[heirs.front()]);
    put_elsewhere(gone);
    take_in(gone, heir);
    finish_cells(gone, static_cast<std::size_t>(config_.max_voxels));
    records_.erase(records_.begin() + static_cast<std::ptrdiff_t>(heirs.front()));
    return;
  }
}

void TagLibrary::forget_oldest_glimpses() {
  std::vector<std::pair<std::int64_t, std::uint32_t>> glimpses;
  for (const TagRecord& record : records_) {
    if (!is_sure(record)) glimpses.emplace_back(record.last_seen_ns, record.id);
  }
  if (glimpses.size() <= kMaxGlimpses) return;
  const std::uint32_t oldest = std::min_element(glimpses.begin(), glimpses.end())->second;
  std::erase_if(records_, [oldest](const TagRecord& record) { return record.id == oldest; });
}

bool TagLibrary::is_sure(const TagRecord& record) const {
  return static_cast<int>(record.sightings.size()) >= config_.min_observations &&
         1.0 - record.doubt >= config_.min_confidence;
}

bool TagLibrary::is_shadowed(const TagRecord& record) const {
  return std::any_of(records_.begin(), records_.end(), [&](const TagRecord& other) {
    if (other.class_name == record.class_name || !is_present(other)) return false;
    const bool is_stronger =
        std::tuple(other.score_sum, record.id) > std::tuple(record.score_sum, other.id);
    return is_stronger && other.box.intersects(record.box) &&
           share_within(record.cells, other.cells, kOverlapSamples) >= kSameThingShare &&
           share_within(other.cells, record.cells, kOverlapSamples) >= kSameThingShare;
  });
}

const std::vector<Tag>& TagLibrary::tags() const {
  list_tags();
  return sure_;
}

const std::vector<Tag>& TagLibrary::tentative() const {
  list_tags();
  return tentative_;
}

void TagLibrary::list_tags() const {
  if (is_listed_) return;
  sure_.clear();
  tentative_.clear();
  for (const TagRecord& record : records_) {
    const bool is_object = is_sure(record) && !is_shadowed(record);
    (is_object ? sure_ : tentative_).push_back(to_tag(record));
  }
  is_listed_ = true;
}

void TagLibrary::adopt_ids(const TagLibrary& before) {
  struct Shared {
    std::size_t count;
    std::uint32_t id_before;
    std::size_t record;
  };
  std::vector<Shared> all;
  for (std::size_t i = 0; i < records_.size(); ++i) {
    for (const TagRecord& old : before.records_) {
      std::vector<Sighting> common;
      std::set_intersection(records_[i].sightings.begin(), records_[i].sightings.end(),
                            old.sightings.begin(), old.sightings.end(), std::back_inserter(common));
      if (!common.empty()) all.push_back({common.size(), old.id, i});
    }
  }
  std::sort(all.begin(), all.end(), [](const Shared& a, const Shared& b) {
    return std::tuple(b.count, a.id_before, a.record) < std::tuple(a.count, b.id_before, b.record);
  });
  std::vector<std::uint32_t> id_of(records_.size(), 0);
  std::vector<std::uint32_t> given;
  for (const Shared& shared : all) {
    const bool is_given = std::find(given.begin(), given.end(), shared.id_before) != given.end();
    if (id_of[shared.record] != 0 || is_given) continue;
    id_of[shared.record] = shared.id_before;
    given.push_back(shared.id_before);
  }
  next_id_ = std::max(next_id_, before.next_id_);
  for (std::size_t i = 0; i < records_.size(); ++i) {
    records_[i].id = id_of[i] != 0 ? id_of[i] : next_id_++;
  }
  std::sort(records_.begin(), records_.end(),
            [](const TagRecord& a, const TagRecord& b) { return a.id < b.id; });
  is_listed_ = false;
}

TagRecord* TagLibrary::find(std::uint32_t id) {
  const auto found = std::find_if(records_.begin(), records_.end(),
                                  [id](const TagRecord& record) { return record.id == id; });
  return found == records_.end() ? nullptr : &*found;
}

}  // namespace tsg
