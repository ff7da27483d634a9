// The fields of a source that a baked region's description and --json write alike: one list of their names.
// Json is an object that is there already; with `[]` on one that is null it would be made too late, and of
// nested initializer lists GCC 12 destroys what was never made.
#pragma once

#include "geo/sources/source_report.h"
#include "geo/sources/source_words.h"

namespace oro {

template <class Json>
Json seam_fields(const SeamReport& seams) {
    Json fields = Json::object();
    fields["shared_posts"] = seams.shared_posts;
    fields["disagreeing_posts"] = seams.disagreeing_posts;
    fields["largest_difference_m"] = seams.largest_difference_m;
    return fields;
}

// Of another datum than WGS84. What is not known has no field.
template <class Json>
Json horizontal_fields(const HorizontalDatum& datum) {
    Json fields = Json::object();
    const auto put = [&](const char* name, const std::optional<double>& value) {
        if (value) fields[name] = *value;
    };
    fields["name"] = datum.name;
    fields["operation"] = datum.operation;
    put("accuracy_m", datum.accuracy_m);
    fields["ballpark"] = datum.ballpark;
    fields["unchanged"] = datum.unchanged;
    fields["one_to_two_metres"] = datum.one_to_two_metres;
    fields["missing_grids"] = datum.missing_grids;
    put("accuracy_with_grids_m", datum.accuracy_with_grids_m);
    put("frame_epoch", datum.frame_epoch);
    put("coordinate_epoch", datum.coordinate_epoch);
    return fields;
}

template <class Json>
Json stored_fields(const StoredRange& stored) {
    Json fields = Json::object();
    fields["lowest_m"] = stored.lowest_m;
    fields["highest_m"] = stored.highest_m;
    fields["whole_file"] = stored.whole;
    return fields;
}

// Without shown_H_m where the region has no ground.
template <class Json>
Json post_fields(const PostShown& post) {
    Json fields = Json::object();
    fields["lat_deg"] = post.lat_deg;
    fields["lon_deg"] = post.lon_deg;
    fields["own_H_m"] = post.own_H_m;
    if (post.shown_H_m) fields["shown_H_m"] = *post.shown_H_m;
    return fields;
}

template <class Json>
Json resampling_fields(const Resampling& found) {
    Json fields = Json::object();
    fields["posts"] = found.posts;
    fields["compared"] = found.compared;
    fields["unshown"] = found.unshown;
    fields["hidden"] = found.hidden;
    fields["rms_m"] = found.rms_m;
    if (found.worst) fields["worst"] = post_fields<Json>(*found.worst);
    if (found.highest) fields["highest"] = post_fields<Json>(*found.highest);
    if (found.lowest) fields["lowest"] = post_fields<Json>(*found.lowest);
    return fields;
}

// What a source says of itself in words.
template <class Json>
void put_source_words(Json& object, const SourceReport& source) {
    object["path"] = source.path;
    object["format"] = format_words(source);
    object["crs"] = source.crs;
    object["vertical_datum"] = datum_words(source.vertical_datum);
    object["height_unit"] = unit_words(source.height_unit);
    object["posts_are"] = posts_words(source.posts_are);
    if (source.listed > 0) object["listed"] = source.listed;
}

// What was found in it.
template <class Json>
void put_source_findings(Json& object, const SourceReport& source) {
    object["voids"] = source.voids;
    object["implausible"] = source.implausible;
    object["placement"] = placement_words(source);
    object["seams"] = seam_fields<Json>(source.seams);
}

}  // namespace oro
