// ---- The page ----------------------------------------------------------------------------------

function buildContents() {
    const sections = [["scaling", "Scaling"], ["passes", "Passes"], ["distributions", "Samples"],
        ["quality", "Quality"], ["comparison", "Comparison"], ["pictures", "Pictures"],
        ["cases", "Cases"], ["environment", "Environment"]];
    showOnly(byId("contents"), ...sections.filter(([id]) => byId(id)).map(
        ([id, text]) => element("a", {href: `#${id}`}, text)));
}

startTheme();
buildSummary();
buildFilter();
buildScaling();
buildPasses();
buildSamples();
buildQuality();
buildComparison();
buildPictures();
buildCases();
buildEnvironment();
buildContents();
