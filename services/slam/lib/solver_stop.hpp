#pragma once

#include <ceres/iteration_callback.h>

#include <functional>

namespace tsg {

/// Ends a Ceres solver after the iteration during which it was asked to.
class SolverStop final : public ceres::IterationCallback {
 public:
  /// `must_stop` may be empty: never. It must outlive this.
  explicit SolverStop(const std::function<bool()>& must_stop) : must_stop_(must_stop) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    has_stopped_ = must_stop_ && must_stop_();
    return has_stopped_ ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  [[nodiscard]] bool has_stopped() const { return has_stopped_; }

 private:
  const std::function<bool()>& must_stop_;
  bool has_stopped_ = false;
};

}  // namespace tsg
