// Helpers for steps in a page, placed before a test's own steps.
const wait = (ms) => new Promise((done) => setTimeout(done, ms));
const said = {};
const say = (name, value) => { said[name] = value === undefined ? null : value; };
await ready;  // the page's own promise
const settle = () => wait(400);  // the text filter waits for 150 ms without a key
const choose = async (id, value) => {
    const list = document.getElementById(id);
    list.value = value;
    list.dispatchEvent(new Event("change"));
    await settle();
};
const type = async (id, text) => {
    const box = document.getElementById(id);
    box.value = text;
    box.dispatchEvent(new Event("input"));
    await settle();
};
const figure = (id) => document.getElementById(id).data;
const column = (table, index) => [...document.querySelectorAll(`#${table} tbody tr`)].map(
    (row) => row.children[index].textContent);
