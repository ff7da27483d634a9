# ctest begins with the longest tests only where it has run them before. So it is told which they are, in seconds: else one
# that begins last runs alone. Tests that are not in the folder that includes this are passed over.
set_tests_properties(
  RandomViews.BoundsAndTolerancesHold
  PROPERTIES COST 60)
set_tests_properties(
  Pipelines/EachCallOfVulkan.FailsWithALineAndNothingLeft/compute
  Pipelines/EachCallOfVulkan.FailsWithALineAndNothingLeft/mesh
  TradeOfViews.PredictionsHoldOnRealTerrain
  PROPERTIES COST 50)
set_tests_properties(
  SameEverywhere.AViewUnderAnImage
  WindowedGraph.HasTheBytesOfOneGo
  PROPERTIES COST 40)
set_tests_properties(
  SkyBands.AreBrokenUpByDither
  Commands/FailedThreads.EachAndAllFromOneOn/Shot
  SameEverywhere.AViewWithEveryEffect
  Memory.OfSixtyFourMegabytesIsEnoughForSixtyEightTiles
  SameEverywhere.EachEffectIsInTheView
  ErrorsOfPictures.OfRealTerrainIsWithinTau
  PROPERTIES COST 30)
set_tests_properties(
  Footprint.HoldsForMaps
  Markers.AreWhereTheMeasureSaysTheyAre
  Footprint.IsTheMeanOfSixtyFourSamples
  ClustersBake.GoesOnWhereItWasBrokenOff
  NetBake.PicturesAreThoseOfItsSources
  WindowedGraph.HasTheBytesOfOneGoInStages
  SameEverywhere.EdgesByChoice
  DamagedGeoidGrid.EveryCommandRefusesAndDoctorNamesTheFile
  OrthoMaps.LieOverTheirSourceInEveryCrs
  RegionGround.SightLinesMeetWhatMarchingFinds
  Paths/Models.CullingChangesNoPixel/mesh
  Bake.PicturesAreThoseOfItsSources
  Window.FliesJumpsTakesAPictureAndLeaves
  Commands/FailedThreads.EachAndAllFromOneOn/ShotOfBaked
  SmoothEdges.AreThoseOfSixtyFourSamples
  RecordedView.LimitsAreTheSameOnBothSides
  AirTables.GroundIsSeenThroughWhatBruteForceGives
  GroundProfile.TenThousandLinesLeaveNothingOut
  ClusterFile.AFlippedBitAnywhereIsFound
  Paths/GridsTogether.LeaveNoGap/mesh
  Viewshed.IsTheLookoutsOverHills
  PROPERTIES COST 20)
set_tests_properties(
  Observer.TenThousandPairsAreTheMarchedLines
  GridsOverEachOther.AreLookedOverTogether
  ShadowsOfPictures.OfRealTerrainAreTheOracles
  AirTables.SkyIsWhatBruteForceGives
  TradeOfViews.PredictionsHoldOnSeveralGrids
  BrokenOffBake.KilledAtAnyMoment
  GraphInBands.RoughGround
  Footprint.HoldsForRandomViews
  PROPERTIES COST 10)
set_tests_properties(
  All/TrustedFormats
  BadInput
  Bake
  DisplayText
  Plan
  PROPERTIES COST 30)
set_tests_properties(
  Accuracy
  ComparedPixels
  DamagedGeoid
  DeviceChoice
  GridsOverEachOther
  HatchToTheHorizon
  Help
  HostileInput
  Region
  Shape
  Shot
  ShotLayers
  Verify
  Window
  PROPERTIES COST 20)
set_tests_properties(
  BakedRegion
  ClusterFile
  Clusters
  Environment
  ExtremeMeasures
  FingerprintsOfViews
  GridClip
  GridsUnderImages
  Hgt
  Jacksboro/GoldenPicture
  NetBake
  OnSummit
  OrthoMaps
  OwnPostsOfShots
  Panorama
  Paths/Choice
  Paths/ClustersByPath
  Paths/Cracks
  Paths/GroundErrorOfPictures
  Paths/Models
  Paths/Occluded
  Paths/ShownParts
  Paths/StreamedClusters
  RecordedView
  RegionWords
  ResamplingReported
  ShotLegend
  SunOfAShot
  Triangles/FullLists
  PROPERTIES COST 12)
