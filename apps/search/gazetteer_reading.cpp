#include "apps/search/gazetteer_reading.h"

#include <utility>

#include "apps/search/gazetteer.h"
#include "core/base/background.h"

namespace oro {
namespace {

GazetteerNames names_in(const std::vector<std::string>& files, const std::stop_token& stop) {
    GazetteerNames all;
    std::vector<SearchPlace> places;
    for (const std::string& file : files) {
        Result<Gazetteer> read = read_gazetteer(file, {}, stop);
        if (stop.stop_requested()) return {};
        if (!read.ok()) {
            all.errors.push_back(read.error());
            continue;
        }
        for (std::string& note : read->notes) all.notes.push_back(std::move(note));
        for (SearchPlace& place : read->places) places.push_back(std::move(place));
    }
    all.names = NameTable(std::move(places));
    return all;
}

}  // namespace

GazetteerReading::GazetteerReading(std::vector<std::string> files) {
    const auto work = [files = std::move(files), stop = stop_.get_token()] { return names_in(files, stop); };
    names_ = begin_in_background(work);
}

GazetteerReading::~GazetteerReading() {
    stop_.request_stop();
}

bool GazetteerReading::ready() const {
    return is_ready(names_);
}

GazetteerNames GazetteerReading::wait() {
    return names_.get();
}

}  // namespace oro
