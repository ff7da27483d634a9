#include "apps/report/resampling_words.h"

#include <cmath>
#include <cstdio>

#include "apps/report/figures.h"
#include "geo/measures/region_resampling.h"

namespace oro {
namespace {

// "27.1", "0.0123", "0"
std::string size_text(double value_m) {
    char text[40];
    std::snprintf(text, sizeof text, value_m >= 100.0 ? "%.0f" : "%.3g", value_m);
    return text;
}

std::string place_text(const PostShown& post) {
    char text[80];
    std::snprintf(text, sizeof text, "%.6f %.6f", post.lat_deg, post.lon_deg);
    return text;
}

std::string height_text(double H_m) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f m", H_m);
    return text;
}

std::string posts_text(std::uint64_t compared, std::uint64_t posts) {
    if (compared == posts) return "all " + grouped(posts) + " posts";
    return grouped(compared) + " of " + grouped(posts) + " posts";
}

std::string file_name(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

}  // namespace

std::string post_words(const PostShown& post) {
    return height_text(post.own_H_m) + " at " + place_text(post) +
           (post.shown_H_m ? ", shown as " + height_text(*post.shown_H_m)
                           : ", where the region has no ground");
}

std::string resampling_words(const Resampling& found) {
    if (!found.worst) return "none of its posts has ground of its own to be compared with";
    const PostShown& worst = *found.worst;
    return size_text(std::abs(*worst.shown_H_m - worst.own_H_m)) + " m off at " + place_text(worst) +
           " (own " + height_text(worst.own_H_m) + ", shown " + height_text(*worst.shown_H_m) + "), " +
           size_text(found.rms_m) + " m RMS, of " + posts_text(found.compared, found.posts);
}

std::string resampling_sentence(const RegionGrid& grid) {
    const auto all = region_resampling(grid);
    if (!all) return "";
    std::string text = "heights of " + counted(all->files, "file are", "files are") + " resampled: ";
    const SourceReport* const worst = worst_resampled(grid);
    if (worst == nullptr) return text + "none of its own posts has ground to be compared with";
    text += "its own posts are up to " + resampling_words(*worst->resampling);
    if (all->files > 1)
        text += " of " + one_line(file_name(worst->path)) + "; " + size_text(all->rms_m) + " m RMS of all " +
                counted(all->files, "file", "files");
    const auto& highest = worst->resampling->highest;
    return highest ? text + "; its highest post: " + post_words(*highest) : text;
}

std::string resampling_line(const RegionGrid& grid) {
    const std::string sentence = resampling_sentence(grid);
    return sentence.empty() ? "" : "Resampled: " + sentence + ". What is measured here begins after that.\n";
}

}  // namespace oro
