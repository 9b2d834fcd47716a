#include "common/io/lumen_motion.hpp"

namespace tether {
namespace {

const PointSeriesKind motion{"Tether lumen motion 2", "motion of a lumen"};
const PointSeriesKind velocity{"Tether blood velocity 2", "blood's velocity"};

}  // namespace

LumenMotionWriter::LumenMotionWriter(std::filesystem::path path, Points imaged)
    : PointSeriesWriter(motion, std::move(path), std::move(imaged)) {}

LumenMotion::LumenMotion(const std::filesystem::path& path) : series_(motion, path) {}

BloodVelocityWriter::BloodVelocityWriter(std::filesystem::path path, Points points)
    : PointSeriesWriter(velocity, std::move(path), std::move(points)) {}

BloodVelocity::BloodVelocity(const std::filesystem::path& path) : PointSeries(velocity, path) {}

}  // namespace tether
