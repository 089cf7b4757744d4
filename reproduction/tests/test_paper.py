"""The papers of docs/paper/: numbers come from runs whose command is named, and words agree with them."""

import re
import sys
from importlib import import_module
from pathlib import Path

import pytest
from yaml import safe_load

TOP = Path(__file__).parents[2]
PAPER = TOP / "docs" / "paper"
sys.path.append(str(TOP / "docs" / "extensions"))
papers = import_module("papers")

SOURCES = {name: (PAPER / name).read_text(encoding="utf-8") for name in ("article.typ", "joss.md")}
BINDINGS = papers.BINDINGS
GIVEN = re.compile(r"#given\[(?:[^\[\]]|\[[^\[\]]*\])*\]")
"""A number that no run found: an input, an equation, or a statement that is tested."""
PLACES_OF_THE_PAPER = re.compile(
    r"\b(?:Figs?\.?|[Ee]qs?\.?|[Ss]ections?|Table)[ \n]\(?\d[\d.()]*(?:(?:, |–|[ \n]and[ \n])\(?\d[\d.()]*)*"
)
"""As in "Figs 27 and 32" and "eqs (21)–(23) and (26)–(48)"."""
WORDS_FOR_NUMBERS = re.compile(
    r"\b(?:half|halves|(?:third|quarter|fifth|tenth|hundredth|dozen|hundred|thousand|million)s?|twice"
    r"|per ?cent|eleven|twelve|twenty|thirty|forty|fifty|ninety|\w+fold)\b"
)


def prose(name: str) -> str:
    """Return what a paper says in words of its own: no comments, code, names, labels or sizes of pictures."""
    text = SOURCES[name]
    if name == "joss.md":
        text = re.sub(r"\A---\n.*?\n---\n", "", text, flags=re.DOTALL)
    text = papers.PLACE.sub("", text)
    text = re.sub(
        r"^//.*$|^#(?:import|bibliography).*$|\bimage\(.*?\)|https?://[^\s\"]+", "", text, flags=re.MULTILINE
    )
    text = re.sub(r"`[^`]*`|<[\w-]+>|@[\w-]+|8.8pt", "", text)
    return GIVEN.sub("", text)


def sections(name: str) -> list[str]:
    """Return the sections of a paper; what stands before the first is not one of them."""
    return re.split(r"^(?:=+|#) ", SOURCES[name], flags=re.MULTILINE)[1:]


def used(text: str) -> set[str]:
    return {found[1] for found in papers.PLACE.finditer(text)}


@pytest.mark.parametrize("name", BINDINGS)
def test_a_number_is_where_its_binding_says(name):
    assert papers.number(name, BINDINGS[name])


def test_each_number_is_used_and_each_that_is_used_is_bound():
    guards = {name for name, binding in BINDINGS.items() if "said" in binding}
    all_used = set().union(*map(used, SOURCES.values()))
    assert all_used - set(BINDINGS) == set()
    assert set(BINDINGS) - all_used - guards == set()
    assert len(all_used) > 50


@pytest.mark.parametrize("name", SOURCES)
def test_no_number_is_typed(name):
    """Digits stand for places of the paper or are marked as given; so do words for numbers."""
    text = prose(name)
    assert re.findall(r".*\d.*", PLACES_OF_THE_PAPER.sub("", text)) == []
    assert WORDS_FOR_NUMBERS.findall(text) == []


@pytest.mark.parametrize(
    "typed", ["in 53% of the", "some 0.35 [0.2, 0.4]", "a third of", "section 1 has 2", "1e-24"]
)
def test_a_typed_number_is_seen(typed, monkeypatch):
    monkeypatch.setitem(SOURCES, "joss.md", f"{SOURCES['joss.md']}\nIt is so {typed} tosses.\n")
    with pytest.raises(AssertionError):
        test_no_number_is_typed("joss.md")


@pytest.mark.parametrize("name", SOURCES)
def test_a_section_names_the_command_of_each_number_in_it(name):
    missing = [
        (section.partition("\n")[0], place)
        for section in sections(name)
        for place in used(section)
        if (of := BINDINGS[place].get("of"))
        and not re.search(rf"`(?:cointoss )?reproduce {of}`|`cointoss reproduce all`", section)
    ]
    assert missing == []


def test_what_the_abstract_has_stands_in_a_section_as_well():
    abstract = SOURCES["article.typ"].partition("\n= ")[0]
    counted = {name for name, binding in BINDINGS.items() if "count" in binding}
    assert len(used(abstract)) == 4
    assert used(abstract) - counted <= used("".join(sections("article.typ")))


def test_words_that_stand_for_a_number_are_there_and_true():
    text = " ".join(" ".join(source.split()) for source in SOURCES.values())
    said = [(name, words, due) for name, it in BINDINGS.items() for words, due in it.get("said", {}).items()]
    numbers = {name: papers.number(name, BINDINGS[name]) for name, *_ in said}
    assert len(said) > 30
    assert [words for _, words, _ in said if words not in text] == []
    assert [(name, words) for name, words, due in said if not is_true(numbers[name], due)] == []


def is_true(number: str, due: str | list[float]) -> bool:
    """Tell whether words for a number are true of it: a verdict, or between two bounds."""
    if isinstance(due, str):
        return number == due
    leading = re.match(r"([-+\d.e]+)( ?%)?(?= |$)", number)
    return leading is not None and due[0] <= float(leading[1]) / (100 if leading[2] else 1) <= due[1]


@pytest.mark.parametrize(
    ("number", "due", "true"),
    [
        ("does not hold", "holds", False),
        ("does not hold", "does not hold", True),
        ("does not hold", [0, 1], False),
        ("0.5 [0.4, 0.6]", [0.6, 0.9], False),
        ("50.2% [49.3%, 51.1%]", [0.45, 0.55], True),
        ("1.2e-05", [1e-5, 2e-5], True),
    ],
)
def test_a_number_that_has_changed_is_seen(number, due, true):
    assert is_true(number, due) == true


def test_the_article_has_five_figures_each_a_picture_of_what_its_caption_names():
    figures = re.findall(
        r'image\("/docs/reproduction/([\w-]+)/([\w-]+\.png)".*?\n\) <', SOURCES["article.typ"], re.DOTALL
    )
    captions = re.findall(r"caption: \[(.*?)\],\n\) <fig-", SOURCES["article.typ"], re.DOTALL)
    assert len(figures) == len(captions) == 5
    for (name, picture), caption in zip(figures, captions, strict=True):
        assert (TOP / "docs" / "reproduction" / name / picture).is_file()
        assert caption.rstrip().endswith(f"`cointoss reproduce {name}`")


def test_every_reference_is_cited_and_every_citation_is_listed():
    listed = re.findall(
        r"^@\w+\{([\w-]+),", (PAPER / "references.bib").read_text(encoding="utf-8"), re.MULTILINE
    )
    assert len(listed) == len(set(listed))
    labels = set(re.findall(r"\n\) <([\w-]+)>", SOURCES["article.typ"]))
    cited = {
        key
        for text in SOURCES.values()
        for key in re.findall(r"(?<![\w.])@([a-z][\w-]*)|cite\(<([\w-]+)>", text)
    }
    assert {one or other for one, other in cited} - labels == set(listed)


def test_the_joss_paper_has_what_joss_asks_for():
    """Its first lines, its sections in their order, and 750 to 1750 words (JOSS, "Paper Format")."""
    _, head, body = SOURCES["joss.md"].split("---\n", 2)
    told = safe_load(head)
    assert {"title", "tags", "authors", "affiliations", "date", "bibliography"} == set(told)
    assert {author["affiliation"] for author in told["authors"]} == {
        each["index"] for each in told["affiliations"]
    }
    assert (PAPER / told["bibliography"]).is_file()
    assert re.findall(r"^# (.*)$", body, re.MULTILINE) == [
        "Summary",
        "Statement of need",
        "State of the field",
        "Software design",
        "Research impact statement",
        "AI usage disclosure",
        "Acknowledgements",
        "References",
    ]
    assert 750 <= len(re.findall(r"[\w'-]+", re.sub(r"\[@[^\]]*\]", "", body))) <= 1750


def test_a_filled_paper_has_no_place_left_and_powers_of_ten():
    for text in map(papers.filled, SOURCES):
        assert "{{" not in text
        assert re.findall(r"\d[eE][+-]\d\d", text) == []


@pytest.mark.parametrize(
    ("binding", "says"),
    [
        ({"of": "edge", "claim": "a coin"}, "with claim 'a coin', not 1"),
        (
            {"of": "edge", "claim": "a nickel lands", "quantity": "on the moon"},
            "0 with quantity 'on the moon', not 1",
        ),
        (
            {"of": "edge", "table": 1, "row": ["as said"], "column": "on the moon"},
            "no one row 'as said' with a column 'on the moon'",
        ),
        (
            {"of": "edge", "claim": "a nickel that wobbles", "told": "analytic", "pick": "(x+)"},
            "no '(x+)' in",
        ),
        ({"of": "moon", "claim": "a coin"}, "No such file"),
    ],
)
def test_a_binding_that_finds_nothing_is_named(binding, says):
    with pytest.raises(papers.BindingError, match=r"^here: ") as raised:
        papers.number("here", binding)
    assert says in str(raised.value)


def test_a_name_that_is_not_bound_is_named(monkeypatch):
    monkeypatch.setattr(papers, "BINDINGS", {})
    with pytest.raises(papers.BindingError, match=r"claims: not in docs/paper/numbers\.toml"):
        papers.filled("joss.md")
