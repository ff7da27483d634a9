<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22.16" styleCategories="Symbology">
  <pipe>
    <rasterrenderer type="singlebandpseudocolor" band="1" opacity="1" alphaBand="-1" nodataColor="" classificationMin="0" classificationMax="1">
      <rasterTransparency/>
      <rastershader>
        <colorrampshader colorRampType="INTERPOLATED" classificationMode="1" clip="0" minimumValue="0" maximumValue="1">
          <item value="0" color="#101018" label="0" alpha="255"/>
          <item value="0.5" color="#3d3d5c" label="0.5" alpha="255"/>
          <item value="0.75" color="#7d7f9c" label="0.75" alpha="255"/>
          <item value="0.9" color="#c3c7d1" label="0.9" alpha="255"/>
          <item value="1" color="#ffffff" label="1" alpha="255"/>
        </colorrampshader>
      </rastershader>
    </rasterrenderer>
    <brightnesscontrast brightness="0" contrast="0" gamma="1"/>
    <huesaturation/>
    <rasterresampler/>
  </pipe>
  <blendMode>0</blendMode>
</qgis>
