#include "engine/ui.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <ranges>

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>
#include <imgui_internal.h>

namespace engine {
namespace {

constexpr float kFontSize = 15.0f;  // px at scale 1
constexpr std::uint32_t kMostTextures = 64;

// Dear ImGui asks for the extension's names of dynamic rendering, which Vulkan 1.3 has without the
// extension.
PFN_vkVoidFunction loadFunction(const char* name, void* instance) {
    const char* wanted = name;
    if (std::strcmp(name, "vkCmdBeginRenderingKHR") == 0) wanted = "vkCmdBeginRendering";
    if (std::strcmp(name, "vkCmdEndRenderingKHR") == 0) wanted = "vkCmdEndRendering";
    return vkGetInstanceProcAddr(static_cast<VkInstance>(instance), wanted);
}

void checkResult(VkResult result) { check(result, "draw the user interface"); }

Handle<VkDescriptorPool, &vkDestroyDescriptorPool> makeDescriptors(VkDevice device) {
    const VkDescriptorPoolSize size{
        .type = VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, .descriptorCount = kMostTextures};
    VkDescriptorPoolCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    create.flags = VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT;
    create.maxSets = kMostTextures;
    create.poolSizeCount = 1;
    create.pPoolSizes = &size;
    VkDescriptorPool pool{};
    check(vkCreateDescriptorPool(device, &create, nullptr, &pool), "create a descriptor pool");
    return {device, pool};
}

// `size`: font height, px.
void addFont(ImFontAtlas& fonts, float size) {
    if (std::filesystem::is_regular_file(HAIRBENCH_UI_FONT)) {
        // Latin with accents, and signs of units and ranges.
        static constexpr ImWchar kGlyphs[] = {0x20,   0x17f,  0x2010, 0x2030, 0x2070,
                                              0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff,
                                              0x370,  0x3ff,  0};
        fonts.AddFontFromFileTTF(HAIRBENCH_UI_FONT, size, nullptr, kGlyphs);
        return;
    }
    ImFontConfig config;
    config.SizePixels = size;
    fonts.AddFontDefault(&config);
}

UiRect rectOf(const ImRect& rect) { return {rect.Min.x, rect.Min.y, rect.Max.x, rect.Max.y}; }

UiItem itemOf(const ImGuiContext& context, ImGuiID id, const ImRect& rect) {
    const ImGuiWindow& window = *context.CurrentWindow;
    UiItem item;
    item.id = id;
    item.window = windowName(window);
    item.rect = item.whole = rectOf(rect);
    for (const ImGuiWindow* around = &window; around; around = around->ParentWindow)
        item.scrolls |= around->ScrollMax.y > 0.0f;
    item.is_window = id == window.ID;
    // A panel's frame is drawn outside the clip rectangle of its widgets.
    item.clip = rectOf(item.is_window ? window.OuterRectClipped : window.ClipRect);
    // Dear ImGui puts widgets without a window into a fallback window.
    item.visible = !window.Hidden && !window.IsFallbackWindow &&
                   rect.Overlaps(item.is_window ? window.Rect() : window.ClipRect);
    return item;
}

}  // namespace

// A child's name is its parent's name, a slash, its own name and a number that makes it unique.
TextPainter::TextPainter(float size) : atlas_(std::make_unique<ImFontAtlas>()) {
    addFont(*atlas_, std::round(size));
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    atlas_->GetTexDataAsAlpha8(&pixels, &width, &height);  // draws the glyphs
}

TextPainter::~TextPainter() = default;

namespace {

// Calls `each` with the glyph of every character.
template <class Each>
void forEachGlyph(const ImFontAtlas& atlas, std::string_view text, const Each& each) {
    const ImFont& font = *atlas.Fonts.front();
    const char* const end = text.data() + text.size();
    for (const char* at = text.data(); at < end;) {
        unsigned code = 0;
        at += std::max(1, ImTextCharFromUtf8(&code, at, end));
        const ImFontGlyph* const glyph = font.FindGlyphNoFallback(static_cast<ImWchar>(code));
        each(glyph ? *glyph : *font.FindGlyph('?'));
    }
}

}  // namespace

float TextPainter::width(std::string_view text) const {
    float width = 0.0f;
    forEachGlyph(*atlas_, text, [&](const ImFontGlyph& glyph) { width += glyph.AdvanceX; });
    return width;
}

void TextPainter::draw(
    Pixels& picture, float left, float top, std::string_view text,
    const std::array<std::uint8_t, 3>& color) const {
    // A glyph may have several texels for a pixel.
    const auto covered = [&](const ImFontGlyph& glyph, int columns, int x, int y) {
        const auto texel = [](float share, int size) {
            return static_cast<int>(std::round(share * static_cast<float>(size)));
        };
        const int first = texel(glyph.U0, atlas_->TexWidth);
        const int count = texel(glyph.U1, atlas_->TexWidth) - first;
        const int from = first + count * x / columns;
        const int to = std::max(from + 1, first + count * (x + 1) / columns);
        const int row = (texel(glyph.V0, atlas_->TexHeight) + y) * atlas_->TexWidth;
        int sum = 0;
        for (int u = from; u < to; ++u) sum += atlas_->TexPixelsAlpha8[row + u];
        return static_cast<float>(sum) / (255.0f * static_cast<float>(to - from));
    };
    forEachGlyph(*atlas_, text, [&](const ImFontGlyph& glyph) {
        const int x0 = static_cast<int>(std::round(left + glyph.X0));
        const int y0 = static_cast<int>(std::round(top + glyph.Y0));
        const int columns = static_cast<int>(std::round(glyph.X1 - glyph.X0));
        const int rows = static_cast<int>(std::round(glyph.Y1 - glyph.Y0));
        for (int y = 0; y < rows && glyph.Visible; ++y) {
            for (int x = 0; x < columns; ++x) {
                if (x0 + x < 0 || x0 + x >= static_cast<int>(picture.width) || y0 + y < 0 ||
                    y0 + y >= static_cast<int>(picture.height))
                    continue;
                const float share = covered(glyph, columns, x, y);
                const auto pixel = static_cast<std::size_t>(y0 + y) * picture.width +
                                   static_cast<std::size_t>(x0 + x);
                for (std::size_t channel = 0; channel < 3; ++channel) {
                    std::uint8_t& value = picture.rgba[4 * pixel + channel];
                    value = static_cast<std::uint8_t>(std::lround(
                        (1.0f - share) * static_cast<float>(value) +
                        share * static_cast<float>(color[channel])));
                }
            }
        }
        left += glyph.AdvanceX;
    });
}

std::string windowName(const ImGuiWindow& window) {
    std::string name = window.Name;
    if (!(window.Flags & ImGuiWindowFlags_ChildWindow)) return name;
    if (window.Flags & (ImGuiWindowFlags_Popup | ImGuiWindowFlags_Tooltip)) return name;
    const std::size_t underscore = name.rfind('_');
    const std::size_t slash = name.rfind('/');
    if (underscore == std::string::npos || slash == std::string::npos || underscore < slash)
        return name;
    const std::string own = name.substr(slash + 1, underscore - slash - 1);
    return (window.ParentWindow ? windowName(*window.ParentWindow) : std::string()) + '/' + own;
}

// ---- Dear ImGui in a window ---------------------------------------------------------------------

Ui::Ui(const Device& device, const Window& window, float scale)
    : device_(device), window_(window), scale_(scale), descriptors_(makeDescriptors(device.get())) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    makeFont();
    ImGui_ImplGlfw_InitForVulkan(window.get(), true);
    ImGui_ImplVulkan_LoadFunctions(loadFunction, device.instance());
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = device.instance();
    info.PhysicalDevice = device.info().handle;
    info.Device = device.get();
    info.QueueFamily = device.info().queue_family;
    info.Queue = device.queue();
    info.PipelineCache = device.pipelineCache();
    info.DescriptorPool = descriptors_.get();
    info.MinImageCount = 2;
    info.ImageCount = 2;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.UseDynamicRendering = true;
    info.ColorAttachmentFormat = Presenter::kFormat;
    info.CheckVkResultFn = checkResult;
    ImGui_ImplVulkan_Init(&info, VK_NULL_HANDLE);
    ImGui_ImplVulkan_CreateFontsTexture();
}

// Fonts have the resolution of the window's pixels, even if a screen coordinate covers several.
void Ui::makeFont() {
    ImGuiIO& io = ImGui::GetIO();
    const float density = window_.density();
    io.Fonts->Clear();
    addFont(*io.Fonts, std::round(kFontSize * scale_ * density));
    io.FontGlobalScale = 1.0f / density;
}

void Ui::setScale(float scale) {
    scale_ = scale;
    check(vkQueueWaitIdle(device_.queue()), "wait for the device");
    makeFont();
    ImGui_ImplVulkan_DestroyFontsTexture();
    ImGui_ImplVulkan_CreateFontsTexture();
}

Ui::~Ui() {
    vkQueueWaitIdle(device_.queue());
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void Ui::begin() {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void Ui::end() { ImGui::Render(); }

void Ui::draw(Commands& commands) {
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands.get());
}

Ui::Texture::Texture(const Device& device, const Image& image) : device_(device) {
    VkSamplerCreateInfo create{};
    create.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    create.magFilter = VK_FILTER_NEAREST;  // keeps the picture's pixels sharp
    create.minFilter = VK_FILTER_LINEAR;
    create.addressModeU = create.addressModeV = create.addressModeW =
        VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    VkSampler sampler{};
    check(vkCreateSampler(device.get(), &create, nullptr, &sampler), "create a sampler");
    sampler_ = {device.get(), sampler};
    id_ = ImGui_ImplVulkan_AddTexture(
        sampler, image.view(), VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

Ui::Texture::~Texture() {
    vkQueueWaitIdle(device_.queue());
    ImGui_ImplVulkan_RemoveTexture(static_cast<VkDescriptorSet>(id_));
}

// ---- The widgets of a picture -------------------------------------------------------------------

UiItems::UiItems() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.TestEngine = this;
    context.TestEngineHookItems = true;
}

UiItems::~UiItems() {
    ImGuiContext& context = *ImGui::GetCurrentContext();
    context.TestEngineHookItems = false;
    context.TestEngine = nullptr;
}

void UiItems::add(int frame, UiItem item) {
    if (frame != frame_) items_.clear();
    frame_ = frame;
    if (early_.id == item.id) {
        item.label = early_.label;
        early_.id = 0;
    }
    // A number field being edited is two widgets in the same place.
    if (!find(item.id)) items_.push_back(std::move(item));
}

UiItem& UiItems::early(std::uint32_t id) {
    early_ = {};
    early_.id = id;
    return early_;
}

UiItem* UiItems::find(std::uint32_t id) {
    // The item has nearly always just been made.
    for (UiItem& item : std::views::reverse(items_))
        if (item.id == id) return &item;
    return nullptr;
}

}  // namespace engine

// ---- Functions that Dear ImGui calls if IMGUI_ENABLE_TEST_ENGINE is defined ---------------------

void ImGuiTestEngineHook_ItemAdd(
    ImGuiContext* context, ImGuiID id, const ImRect& rect, const ImGuiLastItemData* data) {
    if (!context->CurrentWindow) return;
    engine::UiItem item = engine::itemOf(*context, id, rect);
    if (data) {
        item.enabled = (data->InFlags & ImGuiItemFlags_Disabled) == 0;
        item.whole = engine::rectOf(data->Rect);
    }
    static_cast<engine::UiItems*>(context->TestEngine)->add(context->FrameCount, std::move(item));
}

void ImGuiTestEngineHook_ItemInfo(
    ImGuiContext* context, ImGuiID id, const char* label, ImGuiItemStatusFlags flags) {
    auto& items = *static_cast<engine::UiItems*>(context->TestEngine);
    engine::UiItem* item = items.find(id);
    if (!item || items.frame() != context->FrameCount) item = &items.early(id);  // a tab
    if (label) item->label = label;
    item->inputable = (flags & ImGuiItemStatusFlags_Inputable) != 0;
    item->checkable = (flags & ImGuiItemStatusFlags_Checkable) != 0;
    item->checked = (flags & ImGuiItemStatusFlags_Checked) != 0;
    item->openable = (flags & ImGuiItemStatusFlags_Openable) != 0;
    item->open = (flags & ImGuiItemStatusFlags_Opened) != 0;
}

void ImGuiTestEngineHook_Log(ImGuiContext*, const char*, ...) {}

const char* ImGuiTestEngine_FindItemDebugLabel(ImGuiContext* context, ImGuiID id) {
    auto* items = static_cast<engine::UiItems*>(context->TestEngine);
    const engine::UiItem* item = items ? items->find(id) : nullptr;
    return item ? item->label.c_str() : nullptr;
}
