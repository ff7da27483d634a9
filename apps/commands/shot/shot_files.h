// The files that a shot writes: which, whether they may be, and their names at the end.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/accuracy/pixel_check.h"
#include "apps/commands/shot/shot_json.h"
#include "apps/options/options.h"
#include "apps/output/picture_file.h"
#include "apps/output/pose_files.h"

namespace oro {

// Without --out a view goes back to the picture that it came from. Errors: usage.
Result<PictureFiles> shot_files(const ShotOptions& options);

// A picture drawn again from its own view: drawn without a name and compared, so that nothing is replaced.
bool is_check(const ShotOptions& options, const PictureFiles& files);

std::vector<std::string> written_files(const ShotOptions& options, const PictureFiles& files);

// Before anything takes time: that all files can be written where they shall be.
Result<void> check_out(const ShotOptions& options, const PictureFiles& files);

// Where a picture that is only compared would be, if it ever got a name.
PictureFiles unnamed(const PictureFiles& files);

// Gives what was drawn its names, or compares it with the picture that is there. Tags that tell less than
// today's, or of another version of the program, do not make it another picture.
Result<void> finish_shot(const ShotOptions& options, const PictureFiles& files, ShotResult& shot,
                         WholeFile picture, std::vector<WholeFile> companions);

// Reads a picture's pixels along while it is drawn again. What cannot be read is not compared: the bytes tell
// that it is another.
class RepeatedPicture {
  public:
    RepeatedPicture(const std::string& file, const View& view) {
        if (file.empty()) return;
        auto opened = PictureComparison::open(file, view.camera.width_px,
                                              view.camera.height_px + view.legend_px, device_slack);
        if (opened.ok()) comparison_.emplace(std::move(*opened));
    }
    void take(std::span<const std::uint8_t> row) {
        if (comparison_ && !comparison_->add_drawn_row(row).ok()) comparison_.reset();
    }
    std::optional<PictureDifference> found() {
        if (!comparison_) return std::nullopt;
        const auto found = comparison_->finish();
        return found.ok() ? std::optional(*found) : std::nullopt;
    }

  private:
    std::optional<PictureComparison> comparison_;
};

}  // namespace oro
