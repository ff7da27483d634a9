<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>
<qgis version="3.22.16" styleCategories="Symbology">
  <renderer-v2 type="singleSymbol" symbollevels="0" forceraster="0" enableorderby="0">
    <symbols>
      <symbol type="marker" name="0" alpha="1" clip_to_extent="1" force_rhr="0">
        <layer class="SimpleMarker" enabled="1" pass="0" locked="0">
          <prop k="name" v="circle"/>
          <prop k="color" v="154,154,154,255"/>
          <prop k="outline_style" v="no"/>
          <prop k="size" v="1.6"/>
          <prop k="size_unit" v="MM"/>
          <data_defined_properties>
            <Option type="Map">
              <Option type="QString" name="name" value=""/>
              <Option type="Map" name="properties">
                <Option type="Map" name="fillColor">
                  <Option type="bool" name="active" value="true"/>
                  <Option type="QString" name="expression" value="if(&quot;H_m&quot; is null, '#9a9a9a', ramp_color(create_ramp(map(0, '#2b6ca3', 0.33, '#8cc084', 0.66, '#f2d16b', 1, '#b5482f')), if(maximum(&quot;H_m&quot;) &gt; minimum(&quot;H_m&quot;), (&quot;H_m&quot; - minimum(&quot;H_m&quot;)) / (maximum(&quot;H_m&quot;) - minimum(&quot;H_m&quot;)), 0)))"/>
                  <Option type="int" name="type" value="3"/>
                </Option>
              </Option>
              <Option type="QString" name="type" value="collection"/>
            </Option>
          </data_defined_properties>
        </layer>
      </symbol>
    </symbols>
  </renderer-v2>
</qgis>
