// What is left against normal numbers: along the line where it is noise.
{
  const quantiles = page.whole.residual?.normality?.quantiles ?? [];
  if (quantiles.length > 0) {
    const domain = around(quantiles.flat());
    document.getElementById("quantiles").innerHTML = plot({
      id: "n",
      title: "what is left, in its deviations",
      description: `${quantiles.length} quantiles of what is left against those of normal numbers`,
      x: { name: "of normal numbers", domain },
      y: { name: "of what is left", domain },
      series: [{ name: "after", points: quantiles }],
      lines: [[[domain[0], domain[0]], [domain[1], domain[1]]]],
    });
  }
}
