// Many sources, one surface: who wins where they meet, and how much they disagree.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/terrain/post_grid.h"
#include "geo/sources/source.h"
#include "geo/sources/source_report.h"

namespace oro {

// What decides which of several sources wins.
struct Precedence {
    int listed{};  // SourceReport::listed
    double lat_spacing_deg{};
    double lon_spacing_deg{};
    std::string_view path;  // as found
};
// The precedence of a source.
Precedence precedence_of(const SourceReport& source);
// The order in which sources take posts: as they are listed, where that counts; else the finer spacing first
// (the geometric mean of both axes' degrees; equal when within a millionth), among equals by the byte order
// of file names, then of whole paths.
std::vector<std::size_t> by_precedence(std::span<const Precedence> sources);
std::vector<std::size_t> by_precedence(std::span<const Source> sources);

// By how much two files may differ at a post and both be right: what the least accurate data of the whole
// Earth state of nine posts in ten (SRTM, 16 m, LE90: Farr and others, 2007, doi 10.1029/2005RG000183).
inline constexpr double contradiction_m = 16.0;
// One note on the sources that differ by more, at more than half of the posts which they share with those
// that win over them; "" for none.
std::string note_of_contradictions(std::span<const Source> sources);

// The heights of a region while its sources are laid into it.
class JoinedSurface {
  public:
    explicit JoinedSurface(const PostGrid& grid);

    // Lays a stretch of a row: posts that have no height yet take these. `own_posts` says that the source has
    // a post of its own at each (not one interpolated or resampled): where two such meet, the seam is
    // counted. `inside` marks the posts that the source covers, with a height or without.
    // `of_source` counts the source's own posts that an earlier one has, too.
    // Gives how many of the posts an earlier source covered but had no height for.
    std::uint64_t lay(int row, int first_column, std::span<const float> heights,
                      std::span<const unsigned char> inside, bool own_posts, SeamReport& of_source);
    // Keeps heights that count only where no source has one of its own.
    void lay_later(int row, int first_column, std::span<const float> heights);
    // Lays what was kept, makes the first and last column of a region round the Earth one meridian, and gives
    // each pole one height (the mean of its row: all its posts are one point).
    void finish();

    [[nodiscard]] const SeamReport& seams() const { return seams_; }
    // True for posts that some source covers.
    [[nodiscard]] bool covered(std::size_t post) const { return (marks_[post] & covered_mark) != 0; }
    [[nodiscard]] std::vector<float>& heights() { return heights_; }

  private:
    static constexpr unsigned char covered_mark = 1, own_mark = 2, shared_mark = 4, disagreeing_mark = 8;
    struct Later {
        std::size_t post;
        float height;
    };
    bool lay_on_none(std::size_t post, std::span<const float> heights, std::span<const unsigned char> inside,
                     bool own_posts);
    std::uint64_t lay_posts(std::size_t start, std::span<const float> heights,
                            std::span<const unsigned char> inside, bool own_posts, SeamReport& of_source);
    void unite_pole(int row);

    PostGrid grid_;
    std::vector<float> heights_;
    std::vector<unsigned char> marks_;
    std::vector<Later> later_;
    SeamReport seams_;
};

}  // namespace oro
