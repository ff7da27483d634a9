#include "apps/commands/plan_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "apps/report/figures.h"
#include "apps/view/model_names.h"

namespace oro {
namespace {

constexpr std::size_t name_columns = 32, flag_columns = 10, size_columns = 10;
constexpr int before_point = 6;

std::string left_aligned(const std::string& text, std::size_t columns) {
    return text.size() < columns ? text + std::string(columns - text.size(), ' ') : text;
}

std::string pixels(double px) {
    char text[40];
    std::snprintf(text, sizeof text, "%g px", px);
    return text;
}

// Two lines over a part of the table. `judged`: what the second yes or no means.
std::string headings(const char* name, const std::string& judged, const std::string& limit,
                     const char* remark) {
    const auto line = [](const char* first, const std::string& flag, const std::string& other_flag,
                         const std::array<const char*, 4>& sizes, const char* last) {
        std::string text = left_aligned(first, name_columns) + left_aligned(flag, flag_columns) +
                           left_aligned(other_flag, flag_columns);
        for (const char* size : sizes) {
            char cell[20];
            std::snprintf(cell, sizeof cell, "%*s", before_point, size);
            text += left_aligned(cell, size_columns);
        }
        text += std::string("  ") + last;
        text.erase(text.find_last_not_of(' ') + 1);
        return text + "\n";
    };
    return line("", "in this", judged, {"worst", "typical", "worst", "typical"}, "") +
           line(name, "picture", limit, {"m", "m", "px", "px"}, remark);
}

std::string sizes(const std::optional<EffectSize>& size) {
    if (!size) return "     not stated by the source";
    std::string text;
    for (const double value : {size->worst_m, size->typical_m, size->worst_px, size->typical_px})
        text += point_aligned(value, before_point);
    return text;
}

std::string row(const std::string& name, const char* flag, const char* other_flag,
                const std::optional<EffectSize>& size, const std::string& remark) {
    std::string text = left_aligned(name, name_columns) + left_aligned(flag, flag_columns) +
                       left_aligned(other_flag, flag_columns) + sizes(size);
    if (!remark.empty()) text += "  " + remark;
    text.erase(text.find_last_not_of(' ') + 1);
    return text + "\n";
}

const char* yes_or_no(bool yes) {
    return yes ? "yes" : "no";
}

std::string remark_on(const BudgetLine& line, const View& view) {
    std::string remark = facts_of(line.kind).left_out_by;
    if (line.kind == EffectKind::detail) {
        char tau[40];
        std::snprintf(tau, sizeof tau, " %g", view.tau_px > 0.0 ? view.tau_px : 1.0);
        remark += tau;
    }
    return remark;
}

std::string rows(const Budget& budget, EffectGroup group, const View& view) {
    std::string text;
    for (const BudgetLine& line : budget.lines) {
        const EffectFacts& facts = facts_of(line.kind);
        if (facts.group != group) continue;
        const bool of_model = group == EffectGroup::model;
        const char* const judged =
            line.size ? yes_or_no(of_model ? line.needed() : line.within_tolerance) : "-";
        text += row(facts.name, yes_or_no(of_model ? line.modelled : line.in_picture), judged, line.size,
                    remark_on(line, view));
        if (budget.dominant == line.kind) text += "  ^ largest error of this picture\n";
    }
    return text;
}

// Pixels alone: how many metres unknown ground rises nobody can say.
std::string unseen_row(const UnseenGround& unseen, double tolerance_px) {
    if (unseen.all_in_view) return {};
    std::string text;
    const auto add = [&](const char* name, int columns, double bound_px) {
        if (columns == 0) return;
        const std::string nothing = left_aligned(std::string(before_point - 1, ' ') + "-", size_columns);
        text += left_aligned(name, name_columns) + left_aligned("yes", flag_columns) +
                left_aligned(yes_or_no(bound_px <= tolerance_px), flag_columns) + nothing + nothing +
                point_aligned(bound_px, before_point);
        text.erase(text.find_last_not_of(' ') + 1);
        text += "  in " + grouped(static_cast<std::uint64_t>(columns)) + " of " +
                counted(static_cast<std::uint64_t>(unseen.columns), "column", "columns") + "\n";
    };
    add("ground beyond the data", unseen.columns_beyond, unseen.bound_px);
    add("ground beyond the chosen part", unseen.columns_beyond_part, unseen.part_bound_px);
    return text;
}

// Where the data, or the part of them that was chosen, end in view; a line each.
std::string unseen_lines(const UnseenGround& unseen) {
    std::string text;
    for (const std::string& line : {unseen_ending(unseen), beyond_part_ending(unseen)})
        if (!line.empty()) text += "\n" + line;
    return text;
}

// What the heights that are drawn lost before: no effect of drawing, and measured, not predicted.
std::string resampling_row(const Budget& budget) {
    if (!budget.resampling) return {};
    return row("resampled heights", "yes", yes_or_no(budget.resampling->worst_px <= budget.tolerance_px),
               budget.resampling, "");
}

// What grows on the ground, of views that have it: judged as parts of the model are.
std::string vegetation_row(const Budget& budget) {
    if (!budget.vegetation) return {};
    return row("vegetation", "yes", yes_or_no(budget.vegetation->worst_px > budget.tolerance_px),
               budget.vegetation, "no --canopy");
}

// Ground between the posts that the view invents: judged alike.
std::string invented_row(const Budget& budget) {
    if (!budget.invented) return {};
    return row("invented ground", "yes", yes_or_no(budget.invented->worst_px > budget.tolerance_px),
               budget.invented, "--detail 0");
}

// What can be drawn of a region that has clusters.
std::string meshes_text(const std::optional<MeshForecasts>& meshes, const View& view) {
    if (!meshes) return {};
    char text[120];
    std::snprintf(text, sizeof text, "\nWhat is in view at --tau %g, by either mesh:\n", view.tau_px);
    std::string out = text + left_aligned("drawn by", name_columns) + "       triangles";
    out += std::string(flag_columns - 6, ' ') + "   worst m   worst px\n";
    for (const auto& [name, mesh] :
         {std::pair{"blocks (--mesh grid)", meshes->blocks}, {"clusters", meshes->clusters}}) {
        const std::string triangles = grouped(mesh.triangles);
        std::string line = left_aligned(name, name_columns) +
                           std::string(triangles.size() < 16 ? 16 - triangles.size() : 0, ' ') + triangles +
                           std::string(4, ' ') + point_aligned(mesh.worst_m, before_point) +
                           point_aligned(mesh.worst_px, before_point);
        line.erase(line.find_last_not_of(' ') + 1);
        out += line + "\n";
    }
    if (view.mesh == "clusters")
        out +=
            "What is told of full detail, and the sum, are of blocks. Clusters may come nearer to --tau, and "
            "no farther.\n";
    return out;
}

// What this view is good to, and what would make it better.
std::string advice(const Budget& budget, const View& view, const AccuracyChoice& choice,
                   const UnseenGround& unseen) {
    const bool within = budget.total.worst_px <= budget.tolerance_px;
    const std::string tolerance = pixels(budget.tolerance_px);
    const std::string option = "`--accuracy " + std::string(choice.bundle.name) + "`";
    const std::string predicted =
        about_near(budget.tolerance_px, choice.predicted_px) + " px (" + choice.bundle.options + ")";
    std::string text = "Good to " + about_near(budget.tolerance_px, budget.total.worst_px) + " px";
    const std::string ends = unseen_lines(unseen);
    if (!ends.empty()) text += " where the data reach";
    text += (within ? ": within the tolerance of " : ": more than the tolerance of ") + tolerance + ".";
    text += ends;
    if (unseen.all_in_view) text += "\nAll of the data are in the picture, which shows where they end.";
    if (is_drawn_as(choice.bundle, view))
        text += choice.holds ? "\nThat is what " + option + " draws, the cheapest within " + tolerance + "."
                             : "\nThat is what " + option + " draws, and nothing else is closer.";
    else if (within)
        text += "\nThe cheapest within " + tolerance + " is " + option + ": " + predicted + ".";
    else
        text +=
            "\n" + option + " makes it " + predicted + (choice.holds ? "." : ", more than the tolerance.");
    for (const EffectKind kind : choice.left_out) {
        const auto line = std::find_if(budget.lines.begin(), budget.lines.end(),
                                       [&](const BudgetLine& one) { return one.kind == kind; });
        if (line == budget.lines.end() || !line->size || *facts_of(kind).left_out_by == '\0') continue;
        text += "\nLeave `" + std::string(facts_of(kind).left_out_by) + "` out: it alone costs " +
                about(line->size->worst_px) + " px.";
    }
    return text;
}

std::string limit_of_data(const Budget& budget) {
    double worst_px = 0.0;
    bool stated = true;
    if (budget.resampling) worst_px = budget.resampling->worst_px;
    for (const BudgetLine& line : budget.lines) {
        if (facts_of(line.kind).group != EffectGroup::data) continue;
        if (line.size) worst_px = std::max(worst_px, line.size->worst_px);
        stated = stated && line.size.has_value();
    }
    return "The data themselves may be off by " + about(worst_px) + " px, which no setting can help" +
           (stated ? "." : "; and the source does not say how accurate it is.");
}

std::string eye_text(const View& view, const PlanEye& eye) {
    const Geodetic& place = view.camera.eye;
    double heading_deg = std::fmod(std::round(view.camera.attitude.heading_deg * 10.0) / 10.0, 360.0);
    if (heading_deg < 0.0) heading_deg += 360.0;
    std::string above;
    if (eye.above_ground_m)
        above = ", " + metres(std::abs(*eye.above_ground_m)) + " m " +
                (*eye.above_ground_m < 0.0 ? "below" : "above") + " the ground";
    char text[240];
    std::snprintf(text, sizeof text, "Eye: %.6f %.6f, H %s m%s, towards %.4g degrees (%s).\n", place.lat_deg,
                  place.lon_deg, metres(eye.H_m).c_str(), above.c_str(), heading_deg,
                  compass_point(static_cast<int>(std::lround(heading_deg / 22.5))));
    return text;
}

// Whose worst sizes are no derived bounds.
std::string estimates_text(const Budget& budget) {
    std::string names, within;
    for (const BudgetLine& line : budget.lines) {
        const EffectFacts& facts = facts_of(line.kind);
        if (facts.bound != EffectBound::estimated || facts.group != EffectGroup::model) continue;
        const std::string between = names.empty() ? "" : ", ";
        names += between + facts.name;
        if (line.size) within += between + coarse_figure(line.size->p99_px);
    }
    return "Estimates, not bounds: " + names + ".\nThey are the largest of " + grouped(budget.sight_lines) +
           " sight lines, and a margin. 99 % are within " + within + " px.\n";
}

}  // namespace

namespace {

std::string nothing_text(const View& view, const PlanEye& eye, const UnseenGround& unseen) {
    const std::string beyond = unseen_sentence(unseen);
    return eye_text(view, eye) + "nothing of the region is in view: there is nothing to predict\n" +
           (beyond.empty() ? "" : beyond + "\n");
}

std::string ground_text(const Budget& budget, const View& view) {
    char text[240];
    std::snprintf(
        text, sizeof text,
        "Ground in view: from %s m on, half of it beyond %s m; %d x %d px, %g degrees; tolerance %g "
        "px.\n",
        metres(budget.nearest_m).c_str(), metres(budget.median_distance_m).c_str(), view.camera.width_px,
        view.camera.height_px, view.camera.vertical_fov_deg, budget.tolerance_px);
    return text;
}

const char* origin_of(EffectGroup group) {
    switch (group) {
        case EffectGroup::model:
            return "of the view's model";
        case EffectGroup::drawing:
            return "of drawing";
        case EffectGroup::data:
            break;
    }
    return "of the data";
}

// The largest errors that the picture has, on one line each.
std::string largest_errors(const Budget& budget) {
    constexpr std::size_t most = 3;
    std::vector<const BudgetLine*> lines;
    for (const BudgetLine& line : budget.lines)
        if (line.in_picture && line.size) lines.push_back(&line);
    std::ranges::stable_sort(lines, [](const BudgetLine* one, const BudgetLine* other) {
        return one->size->worst_px > other->size->worst_px;
    });
    lines.resize(std::min(most, lines.size()));
    std::string text = left_aligned("Largest errors", name_columns);
    for (const char* const size : {"worst m", "typical", "worst px", "typical"})
        text += left_aligned(std::string("  ") + size, size_columns);
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
    for (const BudgetLine* const line : lines) {
        const EffectFacts& facts = facts_of(line->kind);
        text += left_aligned(error_name(line->kind), name_columns) + sizes(line->size) + "  " +
                origin_of(facts.group) + "\n";
    }
    return text;
}

}  // namespace

std::string plan_summary(const Budget& budget, const View& view, const PlanEye& eye,
                         const AccuracyChoice& choice, const UnseenGround& unseen) {
    if (budget.empty) return nothing_text(view, eye, unseen);
    return eye_text(view, eye) + ground_text(budget, view) + "\n" + advice(budget, view, choice, unseen) +
           "\n" + limit_of_data(budget) + "\n\n" + largest_errors(budget) +
           "--all lists every effect, and what leaves it out.\n";
}

std::string plan_text(const Budget& budget, const View& view, const PlanEye& eye,
                      const AccuracyChoice& choice, const UnseenGround& unseen,
                      const std::optional<MeshForecasts>& meshes) {
    if (budget.empty) return nothing_text(view, eye, unseen);
    const std::string limit = pixels(budget.tolerance_px);
    std::string out = eye_text(view, eye) + ground_text(budget, view);
    out += "Light: " + light_words(budget.air, budget.eye_h_m) +
           (view.model.air == budget.air ? ".\n" : "; in this picture it goes straight.\n");
    out +=
        "Worst: no ground is moved farther than this. So edges and skylines are not moved farther either.\n"
        "Typical: half of the ground is moved by less.\n" +
        estimates_text(budget) + "\n";
    out += "Switch off one part of the model to see how much error that causes:\n";
    out += headings("part of the model", "needed", "for " + limit, "left out by");
    out += rows(budget, EffectGroup::model, view) + vegetation_row(budget) + invented_row(budget);
    out += "\nWhat drawing itself rounds off:\n" + headings("error", "within", limit, "");
    out += rows(budget, EffectGroup::drawing, view);
    out += "\nWhat the data do not tell, and no setting can help:\n" + headings("error", "within", limit, "");
    out += rows(budget, EffectGroup::data, view);
    out += resampling_row(budget) + unseen_row(unseen, budget.tolerance_px);
    out += meshes_text(meshes, view);
    out += "\n" + row("this picture, but for its data", "",
                      yes_or_no(budget.total.worst_px <= budget.tolerance_px), budget.total, "");
    return out + "\n" + advice(budget, view, choice, unseen) + "\n" + limit_of_data(budget) + "\n";
}

}  // namespace oro
