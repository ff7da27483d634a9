// What `plan` prints for people.
#pragma once

#include <optional>
#include <string>

#include "apps/accuracy/beyond_data.h"
#include "apps/accuracy/mesh_forecast.h"
#include "apps/view/accuracy.h"
#include "apps/view/view.h"

namespace oro {

// Where the eye of a view is, for people.
struct PlanEye {
    double H_m;                            // above sea level
    std::optional<double> above_ground_m;  // nothing where there are no data below it
};

// The eye, a table of all effects in three parts, and what they come to in some sentences. Lines of at most
// 120 columns with their line ends, but for the sentences, which are as long as they are.
std::string plan_text(const Budget& budget, const View& view, const PlanEye& eye,
                      const AccuracyChoice& choice, const UnseenGround& unseen,
                      const std::optional<MeshForecasts>& meshes);

// The eye, what the view is good to and what would help in some sentences, and the three largest errors of
// the picture: some twelve lines.
std::string plan_summary(const Budget& budget, const View& view, const PlanEye& eye,
                         const AccuracyChoice& choice, const UnseenGround& unseen);

}  // namespace oro
