#include "apps/commands/sight/raster_styles.h"

#include <filesystem>
#include <string_view>

#include "core/base/file_there.h"

namespace oro {

const char* const viewshed_qml = R"(<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22.16" styleCategories="Symbology">
  <pipe>
    <rasterrenderer type="paletted" band="1" opacity="0.6" alphaBand="-1" nodataColor="">
      <rasterTransparency/>
      <colorPalette>
        <paletteEntry value="0" color="#3d3d46" label="hidden" alpha="90"/>
        <paletteEntry value="1" color="#2ca25f" label="seen" alpha="255"/>
      </colorPalette>
    </rasterrenderer>
    <brightnesscontrast brightness="0" contrast="0" gamma="1"/>
    <huesaturation/>
    <rasterresampler/>
  </pipe>
  <blendMode>0</blendMode>
</qgis>
)";

const char* const horizon_qml = R"(<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22.16" styleCategories="Symbology">
  <pipe>
    <rasterrenderer type="singlebandpseudocolor" band="1" opacity="1" alphaBand="-1" nodataColor="" classificationMin="-5" classificationMax="60">
      <rasterTransparency/>
      <rastershader>
        <colorrampshader colorRampType="INTERPOLATED" classificationMode="1" clip="0" minimumValue="-5" maximumValue="60">
          <item value="-5" color="#26456e" label="-5°" alpha="255"/>
          <item value="0" color="#6f9bc4" label="0°" alpha="255"/>
          <item value="5" color="#cfe0d8" label="5°" alpha="255"/>
          <item value="15" color="#f3dc9b" label="15°" alpha="255"/>
          <item value="30" color="#d98d4f" label="30°" alpha="255"/>
          <item value="60" color="#7f2f1d" label="60°" alpha="255"/>
        </colorrampshader>
      </rastershader>
    </rasterrenderer>
    <brightnesscontrast brightness="0" contrast="0" gamma="1"/>
    <huesaturation/>
    <rasterresampler/>
  </pipe>
  <blendMode>0</blendMode>
</qgis>
)";

std::string style_path(const std::string& raster) {
    return std::filesystem::path(raster).replace_extension(".qml").string();
}

Result<std::optional<WholeFile>> style_beside(const std::string& raster, std::size_t bands, const char* qml) {
    constexpr std::size_t shown_by_values = 2;
    const std::string path = style_path(raster);
    if (bands <= shown_by_values || path.starts_with("/vsi")) return std::optional<WholeFile>();
    ORO_TRY(const bool is_taken, is_there(path));
    if (is_taken) return std::optional<WholeFile>();
    ORO_TRY(WholeFile file, WholeFile::create(path, false));
    const std::string_view text(qml);
    ORO_CHECK(file.write(text.data(), text.size()));
    return std::optional(std::move(file));
}

}  // namespace oro
