#ifndef HAIRBENCH_OPTIONS_H
#define HAIRBENCH_OPTIONS_H

// Ids of the shaders' specialization constants, and the numbers by which shaders know the choices
// of settings. hair/shader_codes.h maps settings to these numbers.

// Depth at the near and at the far plane: engine::kNearDepth, engine::kFarDepth.
const uint kNearDepth = 1u;
const uint kFarDepth = 0u;

// Curves of strands (Curve).
const uint kCurveBspline = 0u;
const uint kCurveBsplineUnpinned = 1u;
const uint kCurveCatmullRom = 2u;
const uint kCurveExtension = 3u;  // from a file that the scene names

// The length over which a strand's width tapers (Taper).
const uint kTaperStrand = 0u;
const uint kTaperSegment = 1u;

// Source of the level of detail (LodMode).
const uint kLodForced = 0u;
const uint kLodDistance = 1u;
const uint kLodCluster = 2u;

// Source of the strands (StrandSource).
const uint kSourceRootTriangles = 0u;
const uint kSourceGroom = 1u;

// Source of the widths (WidthSource).
const uint kWidthScene = 0u;
const uint kWidthGroom = 1u;

// How strands follow guides (Interpolation).
const uint kInterpolationMulti = 0u;
const uint kInterpolationSingle = 1u;
const uint kInterpolationMixed = 2u;

// How bodies move strands where they are drawn (StrandCollision).
const uint kStrandCollisionNone = 0u;
const uint kStrandCollisionPushOut = 1u;

// How strands are distributed over root triangles (Randomness).
const uint kRandomnessHashed = 0u;
const uint kRandomnessThesis = 1u;

// Models of scattering by hair (ShadingModel).
const uint kModelPhong = 0u;
const uint kModelKajiyaKay = 1u;
const uint kModelMarschner = 2u;
const uint kModelDualScattering = 3u;
const uint kModelExtension = 4u;  // from a file that the scene names

// Shadows of hair on hair and meshes (HairShadows).
const uint kHairShadowsNone = 0u;
const uint kHairShadowsDeepOpacity = 1u;
const uint kHairShadowsDeepShadow = 2u;
const uint kHairShadowsRays = 3u;

// How an environment lights hair. Meshes never use the last.
const uint kEnvironmentNone = 0u;
const uint kEnvironmentHarmonics = 1u;  // light on a matt surface
const uint kEnvironmentLights = 2u;  // further lights

// Contents of a picture (Show).
const uint kShowShading = 0u;
const uint kShowTangents = 1u;
const uint kShowNormals = 2u;
const uint kShowLod = 3u;
const uint kShowStrands = 4u;
const uint kShowGroups = 5u;
const uint kShowShadow = 6u;
const uint kShowOverdraw = 7u;
const uint kShowDensity = 8u;

// Conversion from linear light to display colours (ToneMap).
const uint kToneMapNone = 0u;
const uint kToneMapSrgb = 1u;
const uint kToneMapAces = 2u;
const uint kToneMapAgx = 3u;

// Constants of everything that includes strands/strand.glsl: strands/options.glsl.
const uint kCurveConstant = 0u;
const uint kTaperConstant = 1u;
const uint kLodModeConstant = 2u;
const uint kSourceConstant = 3u;
const uint kWidthConstant = 4u;
const uint kOffsetsConstant = 5u;
const uint kInterpolationConstant = 6u;
const uint kCollisionRuleConstant = 7u;
const uint kRandomnessConstant = 8u;
const uint kLodMorphConstant = 9u;
const uint kStrandCollisionConstant = 30u;
const uint kMergedHairsConstant = 31u;
const uint kOwnColorsConstant = 32u;
const uint kResidualsConstant = 33u;
const uint kSkinnedStrandsConstant = 35u;

// Constants of strands/software and strands/mesh: strands/software/software.glsl.
const uint kMostSegmentsConstant = 10u;
const uint kMostPiecesConstant = 11u;
// Constant of those two and of strands/pulling.vert.
const uint kStrandBlockConstant = 12u;
// Invocations of a work group of strands/points and strands/software.
const uint kGroupConstant = 29u;
// Segments per invocation of strands/points/evaluate.comp.
const uint kSegmentRunConstant = 37u;
// Constant of strands/rays/trace.comp.
const uint kBoxesConstant = 38u;

// Constants of the back end `lines`: strands/lines.vert, strands/fragment.glsl.
const uint kStrictLinesConstant = 13u;
const uint kLinesConstant = 14u;

// Constant of strands' quads and fragments: strands/pixel_margin.glsl.
const uint kPixelSamplesConstant = 15u;

// Constants of the back end `mesh`: strands/mesh/block.glsl. The last is the number of invocations
// of a work group of strands/mesh/draw.glsl.
const uint kBlockPointsConstant = 26u;
const uint kTaskGroupConstant = 27u;
const uint kMeshGroupConstant = 28u;

// Constants of a mesh's material: scene/options.glsl.
const uint kBaseColorTextureConstant = 0u;
const uint kMetallicRoughnessTextureConstant = 1u;
const uint kNormalTextureConstant = 2u;
const uint kMaskConstant = 3u;
const uint kDoubleSidedConstant = 4u;

// Constants of lighting, which strands and meshes share: shading/options.glsl.
const uint kModelConstant = 16u;
const uint kLightCountConstant = 17u;
const uint kMeshShadowsConstant = 18u;
const uint kHairShadowsConstant = 19u;
const uint kEnvironmentConstant = 20u;
const uint kLinearLightConstant = 21u;
const uint kAnalyticCoverageConstant = 22u;
const uint kStrandTextureConstant = 23u;
const uint kShowConstant = 24u;
const uint kLightKindsConstant = 25u;
const uint kFarFieldConstant = 34u;

// First constants of the parameters of files that a scene names, three for each: hair/extension.h.
const uint kShadingParameterConstant = 64u;
const uint kOffsetParameterConstant = 128u;
const uint kForceParameterConstant = 192u;
const uint kSolverParameterConstant = 256u;
const uint kCurveParameterConstant = 320u;

// Constant of an offset function from the scene: strands/strand.glsl.
const uint kOffsetReachConstant = 36u;

// Constant of environment/background.frag.
const uint kBackgroundLinearLightConstant = 0u;

// Constants of post/develop.comp. post/resolve.comp uses the first two.
const uint kResolveSamplesConstant = 0u;
const uint kResolveFactorConstant = 1u;
const uint kResolveToneMapConstant = 2u;
const uint kResolveExposureConstant = 3u;

// Invocations along each side of a work group of post/resolve.comp and post/develop.comp.
const uint kResolveGroupSide = 8u;

// Constants of simulation/shape.comp. simulation/shape_serial.comp uses all except the last.
const uint kShapeGroupSizeConstant = 0u;
const uint kShapeVerticesPerStrandConstant = 1u;
const uint kShapeCollidesConstant = 2u;
const uint kShapeTridiagonalConstant = 3u;  // enforces lengths with sweepDown() and sweepUp()
const uint kShapeVerticesPerChunkConstant = 4u;

// Constants of every solver: simulation/constraints/bodies.glsl and simulation/root_frame.glsl.
const uint kContinuousCollisionConstant = 5u;
const uint kSkinnedRootsConstant = 11u;

// Constant of simulation/segments.comp.
const uint kSegmentVerticesConstant = 0u;

// Constants of the solver `rod`: simulation/rod/joint.glsl and simulation/rod.comp.
const uint kEllipticSectionConstant = 6u;
const uint kWarmStartConstant = 7u;
const uint kRodAlphaConstant = 8u;
const uint kRodDampedConstant = 9u;
const uint kRodSegmentsConstant = 10u;
const uint kRodNoSegments = 0u;  // segments do not collide with bodies
const uint kRodSegments = 1u;
const uint kRodSegmentsAtRest = 2u;  // pushed no farther out than they are at rest
const uint kRodSetConstant = 13u;

// Constant of simulation/stable_cosserat.comp.
const uint kCosseratDescentConstant = 12u;

#endif
