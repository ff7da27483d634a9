#include "apps/names/names_in_view.h"

#include <set>
#include <tuple>
#include <utility>

#include "core/base/elapsed.h"

namespace oro {

std::vector<NamedPoint> points_of(const View& view) {
    std::vector<NamedPoint> points;
    if (!view.vectors_read) return points;
    std::set<std::tuple<std::string, double, double>> known;
    for (const auto* const files : {&view.vectors_read->names, &view.vectors_read->overlay}) {
        for (const VectorFile& file : *files) {
            for (NamedPoint& point : named_points(file, view.vectors.names_field)) {
                if (known.emplace(point.name, point.lat_deg, point.lon_deg).second)
                    points.push_back(std::move(point));
            }
        }
    }
    return points;
}

Result<NamesInView> names_in_view(const std::vector<NamedPoint>& points, const PointsInView& in_view,
                                  const Camera& camera, const TextFace& face) {
    NamesInView names;
    const auto start = Clock::now();
    std::vector<SeenPoint> seen = in_view.seen(points, names.counts);
    names.seeing_s = seconds_since(start);
    const auto placing = Clock::now();
    std::vector<SeenPoint> written;
    for (SeenPoint& point : seen) {
        ORO_TRY(const bool has_all, face.has_all(point.name));
        if (has_all)
            written.push_back(std::move(point));
        else
            ++names.without_letters;
    }
    ORO_TRY(names.labels, name_labels(written, camera.width_px, camera.height_px,
                                      [&](const std::string& text, double size_px) {
                                          return face.width_px(text, size_px);
                                      }));
    names.without_room = static_cast<int>(written.size() - names.labels.size());
    ORO_TRY(names.inked, inked_names(face, names.labels));
    names.placing_s = seconds_since(placing);
    return names;
}

std::vector<std::string> notes_of(const NamesInView& names, bool are_asked) {
    std::vector<std::string> notes;
    if (names.without_letters > 0)
        notes.push_back(std::to_string(names.without_letters) +
                        " names are left out: the font has not all of their letters (it has Latin, Greek, "
                        "Cyrillic, Arabic, Hebrew, Armenian and Georgian ones)");
    if (!are_asked || !names.labels.empty()) return notes;
    const std::string why = note_of_no_name(names.counts, static_cast<std::size_t>(names.without_letters),
                                            static_cast<std::size_t>(names.without_room));
    if (!why.empty()) notes.push_back(why);
    return notes;
}

}  // namespace oro
