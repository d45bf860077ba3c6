// The two pages are as high as what they hold, and as light or dark as this one.
{
  const root = document.documentElement;
  for (const frame of document.querySelectorAll("iframe")) {
    const ready = () => {
      const inner = frame.contentDocument.documentElement;
      const fit = () => (frame.style.height = `${inner.offsetHeight}px`);
      const tint = () => root.dataset.theme && (inner.dataset.theme = root.dataset.theme);
      new ResizeObserver(fit).observe(inner);
      new MutationObserver(tint).observe(root, { attributeFilter: ["data-theme"] });
      inner.querySelector("#theme").style.display = "none";
      tint();
      fit();
    };
    if (frame.contentDocument?.readyState === "complete") ready();
    frame.addEventListener("load", ready);
  }
}
