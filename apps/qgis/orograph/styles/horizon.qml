<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
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
