#pragma once

#include <cassert>
#include <cstddef>

#include "hair/gpu_structs.h"
#include "hair/settings.h"

// Numbers that stand for the settings' choices in shaders. They are the enumerators' own values;
// the rows below check these against shaders/shared/options.h. A row with an enumerator of another
// value does not compile, nor does a choice without rows.
namespace hair {

namespace shader_codes {

template <class Choice>
struct Row {
    Choice choice;
    gpu::uint code;
};

// Returns the number of rows if every row's enumerator and code equal its position; otherwise 0.
template <class Choice, std::size_t n>
consteval std::size_t counted(const Row<Choice> (&rows)[n]) {
    for (std::size_t i = 0; i < n; ++i)
        if (static_cast<std::size_t>(rows[i].choice) != i || rows[i].code != i) return 0;
    return n;
}

template <class Choice>
inline constexpr std::size_t kCount = 0;

template <>
inline constexpr std::size_t kCount<Curve> = counted<Curve>(
    {{Curve::bspline, gpu::kCurveBspline},
     {Curve::bspline_unpinned, gpu::kCurveBsplineUnpinned},
     {Curve::catmull_rom, gpu::kCurveCatmullRom},
     {Curve::extension, gpu::kCurveExtension}});

template <>
inline constexpr std::size_t kCount<Taper> =
    counted<Taper>({{Taper::strand, gpu::kTaperStrand}, {Taper::segment, gpu::kTaperSegment}});

template <>
inline constexpr std::size_t kCount<LodMode> = counted<LodMode>(
    {{LodMode::forced, gpu::kLodForced},
     {LodMode::distance, gpu::kLodDistance},
     {LodMode::cluster, gpu::kLodCluster}});

template <>
inline constexpr std::size_t kCount<StrandSource> = counted<StrandSource>(
    {{StrandSource::root_triangles, gpu::kSourceRootTriangles},
     {StrandSource::groom, gpu::kSourceGroom}});

template <>
inline constexpr std::size_t kCount<WidthSource> = counted<WidthSource>(
    {{WidthSource::scene, gpu::kWidthScene}, {WidthSource::groom, gpu::kWidthGroom}});

template <>
inline constexpr std::size_t kCount<Interpolation> = counted<Interpolation>(
    {{Interpolation::multi, gpu::kInterpolationMulti},
     {Interpolation::single, gpu::kInterpolationSingle},
     {Interpolation::mixed, gpu::kInterpolationMixed}});

template <>
inline constexpr std::size_t kCount<Randomness> = counted<Randomness>(
    {{Randomness::hashed, gpu::kRandomnessHashed}, {Randomness::thesis, gpu::kRandomnessThesis}});

template <>
inline constexpr std::size_t kCount<StrandCollision> = counted<StrandCollision>(
    {{StrandCollision::none, gpu::kStrandCollisionNone},
     {StrandCollision::push_out, gpu::kStrandCollisionPushOut}});

template <>
inline constexpr std::size_t kCount<ShadingModel> = counted<ShadingModel>(
    {{ShadingModel::phong, gpu::kModelPhong},
     {ShadingModel::kajiya_kay, gpu::kModelKajiyaKay},
     {ShadingModel::marschner, gpu::kModelMarschner},
     {ShadingModel::dual_scattering, gpu::kModelDualScattering},
     {ShadingModel::extension, gpu::kModelExtension}});

template <>
inline constexpr std::size_t kCount<HairShadows> = counted<HairShadows>(
    {{HairShadows::none, gpu::kHairShadowsNone},
     {HairShadows::deep_opacity, gpu::kHairShadowsDeepOpacity},
     {HairShadows::deep_shadow, gpu::kHairShadowsDeepShadow},
     {HairShadows::rays, gpu::kHairShadowsRays}});

template <>
inline constexpr std::size_t kCount<Show> = counted<Show>(
    {{Show::shading, gpu::kShowShading},
     {Show::tangents, gpu::kShowTangents},
     {Show::normals, gpu::kShowNormals},
     {Show::lod, gpu::kShowLod},
     {Show::strands, gpu::kShowStrands},
     {Show::groups, gpu::kShowGroups},
     {Show::shadow, gpu::kShowShadow},
     {Show::overdraw, gpu::kShowOverdraw},
     {Show::density, gpu::kShowDensity}});

template <>
inline constexpr std::size_t kCount<ToneMap> = counted<ToneMap>(
    {{ToneMap::none, gpu::kToneMapNone},
     {ToneMap::srgb, gpu::kToneMapSrgb},
     {ToneMap::aces, gpu::kToneMapAces},
     {ToneMap::agx, gpu::kToneMapAgx}});

}  // namespace shader_codes

template <class Choice>
constexpr gpu::uint shaderCode(Choice choice) {
    constexpr std::size_t count = shader_codes::kCount<Choice>;
    static_assert(count > 0, "its rows must be in the order of the enumerators and of the codes");
    const auto code = static_cast<gpu::uint>(choice);
    assert(code < count);  // an enumerator without a row
    return code;
}

}  // namespace hair
