<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22.16" styleCategories="Symbology">
  <pipe>
    <rasterrenderer type="singlebandpseudocolor" band="1" opacity="1" alphaBand="-1" nodataColor="" classificationMin="0" classificationMax="90">
      <rasterTransparency/>
      <rastershader>
        <colorrampshader colorRampType="INTERPOLATED" classificationMode="1" clip="0" minimumValue="0" maximumValue="90">
          <item value="0" color="#f7f7f0" label="0°" alpha="255"/>
          <item value="10" color="#d7e8b4" label="10°" alpha="255"/>
          <item value="20" color="#f6e08a" label="20°" alpha="255"/>
          <item value="30" color="#f0a55e" label="30°" alpha="255"/>
          <item value="35" color="#d9603b" label="35°" alpha="255"/>
          <item value="45" color="#a4243b" label="45°" alpha="255"/>
          <item value="60" color="#4a1942" label="60°" alpha="255"/>
          <item value="90" color="#1a0a1a" label="90°" alpha="255"/>
        </colorrampshader>
      </rastershader>
    </rasterrenderer>
    <brightnesscontrast brightness="0" contrast="0" gamma="1"/>
    <huesaturation/>
    <rasterresampler/>
  </pipe>
  <blendMode>0</blendMode>
</qgis>
