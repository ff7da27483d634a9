// The frames of a film, one after the other, of one scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/film/camera_path.h"
#include "apps/options/options.h"
#include "apps/output/picture_file.h"
#include "apps/styles/style.h"
#include "apps/view/view.h"
#include "core/base/result.h"
#include "geo/together/mesh_detail.h"
#include "geo/together/region_ground.h"
#include "render/device/gpu.h"
#include "render/scene/scene.h"

namespace oro {

// Draws frames as shot draws pictures: the same bytes. The scene stays from frame to frame; of a region of
// several grids it is made anew where the eye comes over another of them, as shot has another one there.
class FilmFrames {
  public:
    // All of them outlive it. view: as open_view() gave it, with its way of drawing chosen
    // (draws_clusters()); its eye does not count. region: its region, whose grids change places.
    FilmFrames(const FilmOptions& options, const Gpu& gpu, View& view, Region& region)
        : options_(options), gpu_(gpu), view_(view), region_(region) {}

    // The view of a frame: as the film's, from a key, at a time of the clock.
    [[nodiscard]] View view_of(const CameraKey& key, std::int64_t time_utc_s) const;
    // Whether a file is a frame's picture, whole, of the same data, style and program; no, too, where it
    // cannot be read. Of a JPEG, which does not keep its pixels, the view alone is asked. The view then has
    // the file's legend_px. Errors: a style that cannot be read; the device's.
    Result<bool> is_drawn(const std::string& file, View& view);
    // Draws a frame's picture that is to be `file`, and has no name yet. Errors: those of draw_picture(), of
    // the scene and of the style.
    Result<DrawnPicture> draw(const std::string& file, bool overwrite, View& view,
                              const RenderProgress& progress);
    // Which frames are drawn from now on: nothing else. Said before the first is, it lets made terrain
    // be measured for them alone.
    void set_frames(std::vector<Camera> cameras) { cameras_ = std::move(cameras); }
    // How often the scene was made.
    [[nodiscard]] std::size_t scenes_made() const { return scenes_made_; }

  private:
    void look_from(const Geodetic& eye);
    Result<void> make_scene(const Camera& camera);
    // Draws what a frame needs of the meshes, where its view asks for clusters of them.
    Result<void> choose_meshes(const View& view);

    const FilmOptions& options_;
    const Gpu& gpu_;
    View& view_;
    Region& region_;
    RegionCuts cuts_;
    std::unique_ptr<const RegionGround> ground_;
    std::optional<Scene> scene_;
    std::vector<Camera> cameras_;               // of frames that are to be drawn; none: any may be
    std::shared_ptr<const MeshDetail> meshes_;  // null: all of their triangles are drawn
    MeshCut mesh_cut_;
    std::size_t scenes_made_{};
};

}  // namespace oro
