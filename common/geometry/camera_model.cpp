#include "common/geometry/camera_model.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace tsg {

bool CameraModel::is_distorted() const {
  return std::any_of(distortion.begin(), distortion.end(), [](double k) { return k != 0.0; });
}

CameraModel CameraModel::resized(int new_width, int new_height) const {
  const double scale_x = static_cast<double>(new_width) / width;
  const double scale_y = static_cast<double>(new_height) / height;
  CameraModel scaled = *this;
  scaled.width = new_width;
  scaled.height = new_height;
  scaled.fx = fx * scale_x;
  scaled.fy = fy * scale_y;
  // Pixel centres lie at whole numbers, so that the image begins at -0.5.
  scaled.cx = (cx + 0.5) * scale_x - 0.5;
  scaled.cy = (cy + 0.5) * scale_y - 0.5;
  return scaled;
}

std::vector<std::string> CameraModel::problems() const {
  std::vector<std::string> found;
  if (width <= 0) found.emplace_back("width must be > 0");
  if (height <= 0) found.emplace_back("height must be > 0");
  if (!(fx > 0.0) || !std::isfinite(fx)) found.emplace_back("fx must be > 0");
  if (!(fy > 0.0) || !std::isfinite(fy)) found.emplace_back("fy must be > 0");
  if (!(cx > 0.0 && cx < width)) found.emplace_back("cx must lie inside the image");
  if (!(cy > 0.0 && cy < height)) found.emplace_back("cy must lie inside the image");
  if (!std::all_of(distortion.begin(), distortion.end(),
                   [](double k) { return std::isfinite(k); })) {
    found.emplace_back("distortion coefficients must be finite");
  }
  return found;
}

std::string CameraModel::describe() const {
  std::ostringstream text;
  text.precision(10);  // so that two that differ never look alike
  text << width << 'x' << height << ", fx " << fx << " fy " << fy << " cx " << cx << " cy " << cy;
  if (is_distorted()) {
    text << ", distortion";
    for (const double k : distortion) text << ' ' << k;
  }
  return text.str();
}

}  // namespace tsg
