#include "apps/bench/bench_path.h"

#include "apps/report/json_fields.h"

namespace oro {
namespace {

double number_or(const nlohmann::json& json, const char* name, double low, double high, double otherwise) {
    return json.contains(name) ? json_number(json, name, low, high) : otherwise;
}

BenchEye read_eye(const nlohmann::json& json, const UndulationField& undulation) {
    BenchEye eye;
    eye.name = json_string(json, "name");
    Camera& camera = eye.camera;
    camera.eye = {json_number(json, "lat_deg", -90, 90), json_number(json, "lon_deg", -180, 180), 0.0};
    camera.eye.h_m = json.contains("h_m") ? json_number(json, "h_m", -7e6, 2e9)
                                          : json_number(json, "H_m", -7e6, 2e9) +
                                                undulation.at_m(camera.eye.lat_deg, camera.eye.lon_deg);
    camera.attitude = {json_number(json, "heading_deg", -360, 360), json_number(json, "pitch_deg", -90, 90),
                       number_or(json, "roll_deg", -180, 180, 0.0)};
    camera.vertical_fov_deg = number_or(json, "fov_deg", 0.05, 120, 45.0);
    return eye;
}

}  // namespace

Result<std::vector<BenchEye>> read_bench_path(const std::string& path, const UndulationField& undulation,
                                              int width_px, int height_px) {
    ORO_TRY(const std::string text, read_text_file(path));
    try {
        const nlohmann::json json = parsed_json(text);
        const nlohmann::json& list = json_field(json, "eyes");
        if (!list.is_array() || list.empty()) throw JsonFault{"'eyes' is no list of eyes"};
        std::vector<BenchEye> eyes;
        for (const nlohmann::json& one : list) {
            eyes.push_back(read_eye(one, undulation));
            eyes.back().camera.width_px = width_px;
            eyes.back().camera.height_px = height_px;
        }
        return eyes;
    } catch (const JsonFault& fault) {
        return Error{ErrorKind::failed, path, fault.what};
    } catch (const nlohmann::json::exception& e) {
        return Error{ErrorKind::failed, path, e.what()};
    }
}

}  // namespace oro
