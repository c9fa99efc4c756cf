#include "raytrace/batch/check_job.h"

#include <cmath>

#include "raytrace/batch/settings_error.h"
#include "raytrace/math/blackbody.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// A time in seconds; none is as long as a billion, some 30 years.
void require_time(const char* option, double seconds) {
  if (!(seconds >= 0 && seconds <= 1e9))
    throw SettingsError(std::string(option) + ": " + formatted("%g", seconds) +
                        " s is not a time; it is from 0 to 1e9 seconds");
}

}  // namespace

void require_good_job(const RenderJob& job) {
  if (job.resolution && (job.resolution->width < 1 || job.resolution->height < 1))
    throw SettingsError("--resolution: " + std::to_string(job.resolution->width) + " x " +
                        std::to_string(job.resolution->height) + " pixels are no picture; each is at least 1");
  if (!(job.scale > 0) || !std::isfinite(job.scale))
    throw SettingsError("--scale: " + formatted("%g", job.scale) + " is not a scale; it is a number above 0");
  if (job.tile && (job.tile->count < 1 || job.tile->index < 0 || job.tile->index >= job.tile->count))
    throw SettingsError("--tile: there is no tile " + text_of(*job.tile) +
                        "; of N tiles, the first is 0/N and the last N-1/N");
  if (job.samples && *job.samples < 1)
    throw SettingsError("--samples: " + std::to_string(*job.samples) + " is too few; the least is 1");
  if (job.bit_depth != 8 && job.bit_depth != 16)
    throw SettingsError("--bit-depth: " + std::to_string(job.bit_depth) + " is neither 8 nor 16");
  if (job.view.exposure && !(std::abs(*job.view.exposure) <= largest_exposure))
    throw SettingsError("--exposure: " + formatted("%g", *job.view.exposure) +
                        " is not an exposure; it is a number of stops from -64 to 64");
  if (job.view.white_balance && *job.view.white_balance != 0 && !is_temperature(*job.view.white_balance))
    throw SettingsError("--white-balance: " + formatted("%g", *job.view.white_balance) +
                        " is not a white balance; it is from 1000 to 15000 kelvin, or 0 for none");
  if (job.time_limit) require_time("--time-limit", *job.time_limit);
  require_time("--checkpoint-interval", job.checkpoint_interval);
  if (job.error_limit && !(*job.error_limit > 0 && *job.error_limit <= 1))
    throw SettingsError("--error-limit: " + formatted("%g", *job.error_limit) +
                        " is not an error; it is above 0 and at most 1, such as 0.02 for 2%");
  if (job.resume && job.checkpoint.empty())
    throw SettingsError("--resume goes on from a checkpoint: say which with --checkpoint FILE");
  if (job.error_limit && (job.tile || job.sample_offset))
    throw SettingsError(std::string("--error-limit is for whole pictures and crops: with ") +
                        (job.tile ? "--tile" : "--sample-offset") + " each piece would end at a number of its own");
}

}  // namespace raytrace
