// The view for a projector: the verdict, the coins and the faces alone, in large type.

// `button` opens and closes it, as do the key p and, to close it, Escape; `first` has the keyboard when it is open.
export function makePresentation(button, first) {
  const name = button.textContent;
  let open = false, place = 0;

  function present(wanted) {
    if (wanted === open) return;
    open = wanted;
    if (open) place = scrollY;
    document.body.classList.toggle("presenting", open);
    button.textContent = open ? "Back to the report (Esc)" : name;
    (open ? first : button).focus({ preventScroll: true });
    scrollTo(0, open ? 0 : place);
  }

  button.addEventListener("click", () => present(!open));
  addEventListener("keydown", (event) => {
    // A letter in a list chooses one of its lines.
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches?.("select")) return;
    if (event.key.toLowerCase() === "p") present(!open);
    if (event.key === "Escape") present(false);
  });
}
